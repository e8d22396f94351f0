#include "core/search/travel_clock.hpp"

#include <algorithm>

namespace grainbench {

void TravelClock::restart(const ParticleState& particles, const Vec3& shift) {
    travel_ = 0.0;
    shift_ = shift;
    const auto positions = particles.positions();
    reference_.assign(positions.begin(), positions.end());
}

double TravelClock::measure(const ParticleState& particles,
                            const Vec3& shift,
                            const Kernels& kernels) const {
    const Vec3 frame = shift - shift_;
    TravelPass pass{.position = particles.positions().data(),
                    .reference = reference_.data(),
                    .padded_count = particles.positions().size() / 4,
                    .frame = {frame.x, frame.y, frame.z},
                    .smallest_radius = particles.smallest_radius(),
                    .by_radius = by_radius_,
                    .largest_square = 0.0};
    kernels.measure_travel(pass);
    return std::sqrt(pass.largest_square);
}

bool TravelClock::expired(double limit,
                          const ParticleState& particles,
                          const Vec3& shift,
                          bool exact,
                          const Kernels& kernels) {
    if (travel_ <= limit) {
        return false;
    }
    if (exact) {
        travel_ = measure(particles, shift, kernels);
    }
    return travel_ > limit;
}

void TravelClock::save(Archive& archive, const std::string& name) const {
    archive.put(name + "/travel", std::vector<double>{travel_, shift_.x, shift_.y, shift_.z});
    archive.put(name + "/reference", std::vector<double>(reference_.begin(), reference_.end()));
}

void TravelClock::load(const Archive& archive,
                       const std::string& name,
                       const ParticleState& particles) {
    const auto& travel = archive.get<double>(name + "/travel", 4);
    travel_ = travel[0];
    shift_ = {travel[1], travel[2], travel[3]};
    const auto& reference = archive.get<double>(name + "/reference", particles.positions().size());
    reference_.assign(reference.begin(), reference.end());
}

}  // namespace grainbench
