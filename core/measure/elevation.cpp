#include "core/measure/elevation.hpp"

#include "core/schedule.hpp"

#include <array>
#include <limits>

namespace grainbench {

namespace {

double mean_height(const ParticleState& particles,
                   const std::vector<Index>& slots,
                   const Vec3& up) {
    // Four sums, so that an addition need not wait for the one before.
    std::array<double, 4> sums{};
    for (std::size_t k = 0; k < slots.size(); ++k) {
        sums[k % 4] += dot(up, particles.position(slots[k]));
    }
    const double sum = (sums[0] + sums[1]) + (sums[2] + sums[3]);
    return sum / static_cast<double>(slots.size());
}

constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::optional<double> if_number(double x) {
    return std::isnan(x) ? std::nullopt : std::optional<double>(x);
}

}  // namespace

Elevation::Elevation(std::vector<Index> upper, std::vector<Index> lower, const Vec3& up)
    : upper_(std::move(upper)), lower_(std::move(lower)), up_(up) {}

void Elevation::begin_interval(double t, double interval) {
    origin_ = t;
    interval_ = interval;
    complete_ = 0;
    sum_ = 0.0;
    count_ = 0;
}

void Elevation::renumber(const PopulationChange& change) {
    for (std::vector<Index>* slots : {&upper_, &lower_}) {
        for (Index& slot : *slots) {
            slot = change.slot_after[slot];
        }
        std::erase(*slots, PopulationChange::gone);
    }
}

double Elevation::compute(const ParticleState& particles) const {
    return mean_height(particles, upper_, up_) - mean_height(particles, lower_, up_);
}

void Elevation::sample(const ParticleState& particles, double t) {
    last_ = compute(particles);
    if (last_ > 0.0 && !entrainment_time_) {
        entrainment_time_ = t;
    }
    sum_ += last_;
    ++count_;
    if (t >= origin_ + static_cast<double>(complete_ + 1) * interval_) {
        average_ = sum_ / static_cast<double>(count_);
        sum_ = 0.0;
        count_ = 0;
        complete_ = last_due(t, origin_, interval_, complete_ + 1);
    }
}

void Elevation::name_columns(std::vector<HistoryColumn>& columns) const {
    columns.push_back({"elevation", "m", "mean height of the upper group over the lower"});
    columns.push_back({"elevation_average", "m", "its mean over the last complete interval"});
}

void Elevation::append_row(const MeasureView& view, std::vector<double>& row) const {
    row.push_back(compute(view.particles));
    row.push_back(average_.value_or(none));
}

void Elevation::save(Archive& archive) const {
    archive.put("elevation/numbers",
                std::vector<double>{origin_,
                                    interval_,
                                    sum_,
                                    last_,
                                    average_.value_or(none),
                                    entrainment_time_.value_or(none)});
    archive.put("elevation/counts", std::vector<std::uint64_t>{complete_, count_});
}

void Elevation::save_members(Archive& archive) const {
    archive.put("elevation/upper", upper_);
    archive.put("elevation/lower", lower_);
}

void Elevation::load_members(const Archive& archive, Index particle_count) {
    upper_ = archive.get<Index>("elevation/upper");
    lower_ = archive.get<Index>("elevation/lower");
    for (const std::vector<Index>* slots : {&upper_, &lower_}) {
        for (const Index slot : *slots) {
            Archive::require(slot < particle_count, "elevation");
        }
    }
}

void Elevation::load(const Archive& archive) {
    const auto& numbers = archive.get<double>("elevation/numbers", 6);
    Archive::require(origin_ == numbers[0] && interval_ == numbers[1], "elevation/numbers");
    sum_ = numbers[2];
    last_ = numbers[3];
    average_ = if_number(numbers[4]);
    entrainment_time_ = if_number(numbers[5]);
    const auto& counts = archive.get<std::uint64_t>("elevation/counts", 2);
    complete_ = counts[0];
    count_ = counts[1];
}

}  // namespace grainbench
