/// What acts on every particle beside its contacts.
#pragma once

#include "core/body/laws/local_damping.hpp"
#include "core/state/particle_state.hpp"

namespace grainbench {

struct BodyForces {
    Vec3 gravity{};              ///< [m/s^2]; zero where weight is among the forces
    double local_damping = 0.0;  ///< [1] coefficient

    /// Of a particle under its present forces [m/s^2]; zero if it is driven.
    Vec3 acceleration(const ParticleState& particles, Index slot) const {
        if (particles.is_driven(slot)) {
            return {};
        }
        const Vec3 a = particles.inverse_mass(slot) * particles.force(slot) + gravity;
        return damped(a, particles.velocity(slot));
    }

    /// [rad/s^2]
    Vec3 angular_acceleration(const ParticleState& particles, Index slot) const {
        const Vec3 a = particles.inverse_inertia(slot) * particles.torque(slot);
        return damped(a, particles.spin(slot));
    }

    /// \param velocity at the half step before, which is what the integrator goes by
    Vec3 damped(const Vec3& a, const Vec3& velocity) const {
        if (local_damping == 0.0) {
            return a;
        }
        return {LocalDamping::damped(local_damping, a.x, velocity.x),
                LocalDamping::damped(local_damping, a.y, velocity.y),
                LocalDamping::damped(local_damping, a.z, velocity.z)};
    }
};

}  // namespace grainbench
