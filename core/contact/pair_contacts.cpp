#include "core/contact/pair_contacts.hpp"

#include <algorithm>
#include <numeric>

namespace grainbench {

namespace {

bool overlap(const ParticleState& particles, Index a, Index b) {
    const Vec3 apart = particles.position(b) - particles.position(a);
    const double sum = particles.radius(a) + particles.radius(b);
    return dot(apart, apart) <= sum * sum;
}

std::uint64_t key(const PairList& list, Index k) {
    return (static_cast<std::uint64_t>(list.i[k]) << 32) | list.j[k];
}

template <class T>
std::vector<T> plain(const Column<T>& column, std::size_t count) {
    return {column.begin(), column.begin() + static_cast<std::ptrdiff_t>(count)};
}

}  // namespace

PairContacts::PairContacts(const SearchSettings& settings, int history_size)
    : settings_(settings), history_size_(history_size) {}

void PairContacts::change_history(std::span<const int> sources) {
    const Column<double> old = std::move(history_);
    history_size_ = static_cast<int>(sources.size());
    history_.assign(history_stride_ * sources.size(), 0.0);
    for (std::size_t c = 0; c < sources.size(); ++c) {
        if (sources[c] >= 0) {
            const auto from = static_cast<std::size_t>(sources[c]) * history_stride_;
            std::copy_n(old.begin() + static_cast<std::ptrdiff_t>(from),
                        history_stride_,
                        history_.begin() + static_cast<std::ptrdiff_t>(c * history_stride_));
        }
    }
}

void PairContacts::add_travel(double bound) {
    near_clock_.add(bound);
    candidate_clock_.add(bound);
    soon_travel_ += bound;
    last_travel_ = bound;
}

bool PairContacts::is_due(std::uint64_t cycle,
                          const ParticleState& particles,
                          const Vec3& bed_shift) {
    if (!started_) {
        return true;
    }
    if (settings_.brute_force) {
        return false;
    }
    if (settings_.interval > 0) {
        return cycle >= last_cycle_ + static_cast<std::uint64_t>(settings_.interval);
    }
    return near_clock_.expired(settings_.near_travel(soon_limit_, particles.smallest_radius()),
                               particles,
                               bed_shift,
                               true);
}

Renewal PairContacts::update(std::uint64_t cycle,
                             const ParticleState& particles,
                             const Vec3& bed_shift,
                             const Kernels& kernels) {
    if (is_due(cycle, particles, bed_shift)) {
        if (!started_ || candidate_clock_.expired(settings_.slack, particles, bed_shift, true)) {
            build_candidates(particles, bed_shift);
        }
        renew(particles, kernels);
        renew_soon(particles, kernels);
        near_clock_.restart(particles, bed_shift);
        last_cycle_ = cycle;
        started_ = true;
        return Renewal::objects;
    }
    if (soon_travel_ > soon_limit_ && !settings_.brute_force) {
        renew_soon(particles, kernels);
        return Renewal::soon;
    }
    return Renewal::none;
}

void PairContacts::renew_soon(const ParticleState& particles, const Kernels& kernels) {
    soon_limit_ = settings_.soon_travel(last_travel_, particles.smallest_radius());
    soon_travel_ = 0.0;
    found_.resize(contacts_.i.size());
    Index count = contacts_.count;
    if (settings_.brute_force) {
        std::iota(found_.begin(), found_.end(), Index{0});
    } else {
        count = kernels.find_pairs({particles.positions().data(),
                                    contacts_.i.data(),
                                    contacts_.j.data(),
                                    contacts_.count,
                                    1.0,
                                    2.0 * soon_limit_,
                                    found_.data()});
    }
    soon_.clear();
    soon_place_.assign(found_.begin(), found_.begin() + count);
    for (Index k = 0; k < count; ++k) {
        soon_.append(contacts_.i[found_[k]], contacts_.j[found_[k]]);
    }
    soon_.pad();
}

void PairContacts::build_candidates(const ParticleState& particles, const Vec3& bed_shift) {
    if (settings_.brute_force) {
        candidates_.clear();
        for (Index a = 0; a < particles.size(); ++a) {
            for (Index b = a + 1; b < particles.size(); ++b) {
                candidates_.append(a, b);
            }
        }
        candidates_.pad();
    } else {
        finder_.find(particles, 1.0 + settings_.tolerance, 2.0 * settings_.slack, candidates_);
    }
    candidate_clock_.restart(particles, bed_shift);
    ++builds_;
}

void PairContacts::renew(const ParticleState& particles, const Kernels& kernels) {
    const PairList old_list = std::move(contacts_);
    const std::vector<std::uint8_t> old_active = std::move(active_);
    const Column<double> old_history = std::move(history_);
    const std::size_t old_stride = history_stride_;

    Column<Index> found(static_cast<std::size_t>(candidates_.count) + 8);
    Index count = candidates_.count;
    if (settings_.brute_force) {
        for (Index k = 0; k < count; ++k) {
            found[k] = k;
        }
    } else {
        count = kernels.find_pairs({particles.positions().data(),
                                    candidates_.i.data(),
                                    candidates_.j.data(),
                                    candidates_.count,
                                    1.0 + settings_.tolerance,
                                    0.0,
                                    found.data()});
    }
    contacts_ = {};
    contacts_.i.reserve(count + 16);
    contacts_.j.reserve(count + 16);
    for (Index k = 0; k < count; ++k) {
        contacts_.append(candidates_.i[found[k]], candidates_.j[found[k]]);
    }
    contacts_.pad();
    active_.assign(contacts_.i.size(), 0);
    history_stride_ = contacts_.i.size();
    history_.assign(history_stride_ * static_cast<std::size_t>(history_size_), 0.0);
    touching_.resize(contacts_.i.size());
    carry_over(particles, old_list, old_active, old_history, old_stride);
    collect_active();
    ++renewals_;
}

void PairContacts::carry_over(const ParticleState& particles,
                              const PairList& old_list,
                              const std::vector<std::uint8_t>& old_active,
                              const Column<double>& old_history,
                              std::size_t old_stride) {
    Index old = 0;
    for (Index k = 0; k < contacts_.count; ++k) {
        while (old < old_list.count && key(old_list, old) < key(contacts_, k)) {
            ++old;
        }
        if (old < old_list.count && key(old_list, old) == key(contacts_, k)) {
            active_[k] = old_active[old];
            for (int h = 0; h < history_size_; ++h) {
                const auto column = static_cast<std::size_t>(h);
                history_[column * history_stride_ + k] = old_history[column * old_stride + old];
            }
        } else if (overlap(particles, contacts_.i[k], contacts_.j[k])) {
            // Born overlapping: the whole of its first step counts (physics reference 1.3).
            active_[k] = 1;
            late_ += started_ ? 1 : 0;
        }
    }
}

void PairContacts::collect_active() {
    touched_before_.resize(contacts_.i.size());
    touched_before_count_ = 0;
    for (Index k = 0; k < contacts_.count; ++k) {
        if (active_[k] != 0) {
            touched_before_[touched_before_count_++] = k;
        }
    }
}

bool PairContacts::find_touching(const ParticleState& particles, const Kernels& kernels) {
    touching_count_ = kernels.find_pairs({particles.positions().data(),
                                          soon_.i.data(),
                                          soon_.j.data(),
                                          soon_.count,
                                          1.0,
                                          0.0,
                                          touching_.data()});
    for (Index t = 0; t < touching_count_; ++t) {
        touching_[t] = soon_place_[touching_[t]];
    }
    bool changed = touching_count_ != touched_before_count_;
    Index now = 0;
    for (Index before = 0; before < touched_before_count_; ++before) {
        const Index place = touched_before_[before];
        while (now < touching_count_ && touching_[now] < place) {
            ++now;
        }
        if (now == touching_count_ || touching_[now] != place) {
            changed = true;
            active_[place] = 0;
            for (int h = 0; h < history_size_; ++h) {
                history_[static_cast<std::size_t>(h) * history_stride_ + place] = 0.0;
            }
        }
    }
    return changed;
}

void PairContacts::add_forces(ParticleState& particles,
                              const ContactTable& table,
                              double timestep,
                              bool records,
                              const Kernels& kernels) {
    if (records) {
        records_.resize(static_cast<std::size_t>(touching_count_) * record_size);
    }
    kernels.pair_pass(table.combination(),
                      records,
                      {.particles = particles.view(),
                       .laws = table.view(timestep),
                       .i = contacts_.i.data(),
                       .j = contacts_.j.data(),
                       .touching = touching_.data(),
                       .touching_count = touching_count_,
                       .active = active_.data(),
                       .history = history_.data(),
                       .history_stride = history_stride_,
                       .records = records_.data()});
    std::swap(touched_before_, touching_);
    std::copy_n(touched_before_.begin(), touching_count_, touching_.begin());
    touched_before_count_ = touching_count_;
}

void PairContacts::save(Archive& archive) const {
    near_clock_.save(archive, "pairs/near_clock");
    candidate_clock_.save(archive, "pairs/candidate_clock");
    archive.put("pairs/candidate_i", plain(candidates_.i, candidates_.count));
    archive.put("pairs/candidate_j", plain(candidates_.j, candidates_.count));
    archive.put("pairs/contact_i", plain(contacts_.i, contacts_.count));
    archive.put("pairs/contact_j", plain(contacts_.j, contacts_.count));
    archive.put("pairs/soon_i", plain(soon_.i, soon_.count));
    archive.put("pairs/soon_j", plain(soon_.j, soon_.count));
    archive.put("pairs/soon_place", plain(soon_place_, soon_place_.size()));
    archive.put("pairs/soon_clock", std::vector<double>{last_travel_, soon_travel_, soon_limit_});
    archive.put("pairs/active", active_);
    archive.put("pairs/history", plain(history_, history_.size()));
    archive.put("pairs/touching", plain(touching_, touching_count_));
    archive.put("pairs/records", plain(records_, records_.size()));
    archive.put("pairs/counters",
                std::vector<std::uint64_t>{last_cycle_, late_, renewals_, builds_});
}

void PairContacts::load(const Archive& archive) {
    near_clock_.load(archive, "pairs/near_clock");
    candidate_clock_.load(archive, "pairs/candidate_clock");
    const auto restore = [&](PairList& list, const std::string& name) {
        const auto& i = archive.get<std::uint32_t>("pairs/" + name + "_i");
        const auto& j = archive.get<std::uint32_t>("pairs/" + name + "_j");
        list.clear();
        list.i.assign(i.begin(), i.end());
        list.j.assign(j.begin(), j.end());
        list.count = static_cast<Index>(i.size());
        list.pad();
    };
    restore(candidates_, "candidate");
    restore(contacts_, "contact");
    restore(soon_, "soon");
    const auto& places = archive.get<std::uint32_t>("pairs/soon_place");
    soon_place_.assign(places.begin(), places.end());
    const auto& clock = archive.get<double>("pairs/soon_clock");
    last_travel_ = clock.at(0);
    soon_travel_ = clock.at(1);
    soon_limit_ = clock.at(2);
    active_ = archive.get<std::uint8_t>("pairs/active");
    const auto& history = archive.get<double>("pairs/history");
    history_.assign(history.begin(), history.end());
    history_stride_ = contacts_.i.size();
    const auto& touching = archive.get<std::uint32_t>("pairs/touching");
    touching_.assign(contacts_.i.size(), 0);
    std::copy(touching.begin(), touching.end(), touching_.begin());
    touching_count_ = static_cast<Index>(touching.size());
    const auto& records = archive.get<double>("pairs/records");
    records_.assign(records.begin(), records.end());
    const auto& counters = archive.get<std::uint64_t>("pairs/counters");
    last_cycle_ = counters.at(0);
    late_ = counters.at(1);
    renewals_ = counters.at(2);
    builds_ = counters.at(3);
    started_ = true;
    collect_active();
}

}  // namespace grainbench
