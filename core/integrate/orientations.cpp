#include "core/integrate/orientations.hpp"

#include <cmath>

namespace grainbench {

void Orientations::advance(const ParticleState& particles, double timestep) {
    for (Index slot = 0; slot < particles.size(); ++slot) {
        const Vec3 a = 0.5 * timestep * particles.spin(slot);
        if (a == Vec3{}) {
            continue;
        }
        Quaternion& q = quaternions_[slot];
        const Vec3 v{q[1], q[2], q[3]};
        const double w = q[0] - dot(a, v);  // (1)
        const Vec3 turned = v + q[0] * a + cross(a, v);
        const double length = std::sqrt(w * w + dot(turned, turned));
        q = {w / length, turned.x / length, turned.y / length, turned.z / length};
    }
}

void Orientations::save(Archive& archive) const {
    std::vector<double> components;
    for (const Quaternion& q : quaternions_) {
        components.insert(components.end(), q.begin(), q.end());
    }
    archive.put("particles/orientation", components);
}

void Orientations::load(const Archive& archive, Index count) {
    const auto& components = archive.get<double>("particles/orientation", 4 * std::size_t{count});
    quaternions_.resize(count);
    for (std::size_t slot = 0; slot < count; ++slot) {
        for (std::size_t c = 0; c < 4; ++c) {
            quaternions_[slot][c] = components[4 * slot + c];
        }
    }
}

}  // namespace grainbench
