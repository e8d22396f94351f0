#include "core/measure/softening.hpp"

#include <algorithm>
#include <cmath>

namespace grainbench {

std::optional<Softening> softening_of(const ContactScales& scales, double speed) {
    Softening softening;
    softening.speed = speed;
    for (const ContactTime& time : scales.times) {
        const double ratio = speed * time.depth / time.radius;  // (1)
        if (std::isfinite(ratio) && ratio > softening.overlap_ratio) {
            softening.overlap_ratio = ratio;
            softening.first = time.first;
            softening.second = time.second;
        }
    }
    if (!(softening.overlap_ratio > 0.0)) {
        return std::nullopt;
    }
    softening.speed_up = harmless_overlap / softening.overlap_ratio;
    softening.factor = scales.stiffens ? 1.0 / std::pow(softening.speed_up, 2.5)
                                       : 1.0 / (softening.speed_up * softening.speed_up);  // (2)
    return softening;
}

double speed_of_fall(const Scene& scene, const ParticleFrame& particles) {
    const Vec3 gravity = scene.gravity.value_or(Vec3{});
    const double g = norm(gravity);
    if (!(g > 0.0) || particles.size() == 0) {
        return 0.0;
    }
    double low = dot(particles.position.front(), gravity) / g;
    double high = low;
    for (const Vec3& position : particles.position) {
        low = std::min(low, dot(position, gravity) / g);
        high = std::max(high, dot(position, gravity) / g);
    }
    return std::sqrt(2.0 * g * (high - low));
}

}  // namespace grainbench
