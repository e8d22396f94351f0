#include "core/search/travel_clock.hpp"

#include <algorithm>

namespace grainbench {

void TravelClock::restart(const ParticleState& particles, const Vec3& shift) {
    travel_ = 0.0;
    shift_ = shift;
    const auto positions = particles.positions();
    reference_.assign(positions.begin(), positions.end());
}

double TravelClock::measure(const ParticleState& particles, const Vec3& shift) const {
    const Vec3 frame = shift - shift_;
    const double smallest_square = particles.smallest_radius() * particles.smallest_radius();
    const double* now = particles.positions().data();
    double largest = 0.0;
    for (std::size_t k = 0; k < 4 * static_cast<std::size_t>(particles.size()); k += 4) {
        const double x = now[k] - reference_[k] - frame.x;
        const double y = now[k + 1] - reference_[k + 1] - frame.y;
        const double z = now[k + 2] - reference_[k + 2] - frame.z;
        const double square = x * x + y * y + z * z;
        const double scale = by_radius_ ? smallest_square / (now[k + 3] * now[k + 3]) : 1.0;
        largest = std::max(largest, square * scale);
    }
    return std::sqrt(largest);
}

bool TravelClock::expired(double limit,
                          const ParticleState& particles,
                          const Vec3& shift,
                          bool exact) {
    if (travel_ <= limit) {
        return false;
    }
    if (exact) {
        travel_ = measure(particles, shift);
    }
    return travel_ > limit;
}

void TravelClock::save(Archive& archive, const std::string& name) const {
    archive.put(name + "/travel", std::vector<double>{travel_, shift_.x, shift_.y, shift_.z});
    archive.put(name + "/reference", reference_);
}

void TravelClock::load(const Archive& archive, const std::string& name) {
    const auto& travel = archive.get<double>(name + "/travel");
    travel_ = travel.at(0);
    shift_ = {travel.at(1), travel.at(2), travel.at(3)};
    reference_ = archive.get<double>(name + "/reference");
}

}  // namespace grainbench
