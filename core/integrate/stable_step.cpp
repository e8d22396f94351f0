#include "core/integrate/stable_step.hpp"

#include <algorithm>
#include <limits>

namespace grainbench {

StableStep::StableStep(Index particle_count)
    : sums_(6 * static_cast<std::size_t>(particle_count)), listed_(particle_count, 0) {}

void StableStep::clear() {
    for (const Index slot : list_) {
        std::fill_n(sums_.begin() + 6 * static_cast<std::ptrdiff_t>(slot), 6, 0.0);
        listed_[slot] = 0;
    }
    list_.clear();
}

void StableStep::add(Index slot,
                     const double (&normal_squares)[3],
                     double lever,
                     const StepStiffness& stiffness,
                     bool rotation_only) {
    if (listed_[slot] == 0) {
        listed_[slot] = 1;
        list_.push_back(slot);
    }
    double* sum = sums_.data() + 6 * static_cast<std::size_t>(slot);
    const double turning = stiffness.shear * lever * lever;
    for (int axis = 0; axis < 3; ++axis) {
        sum[3 + axis] += turning * (1.0 - normal_squares[axis]);  // (2)
    }
    if (!rotation_only) {
        for (int axis = 0; axis < 3; ++axis) {
            sum[axis] += stiffness.normal * normal_squares[axis] +
                         stiffness.shear * (1.0 - normal_squares[axis]);  // (2)
        }
    }
}

void StableStep::add_pair(const ParticleState& particles,
                          const ContactTable& table,
                          Index i,
                          Index j) {
    const Vec3 apart = particles.position(j) - particles.position(i);
    const double square = dot(apart, apart);
    const double inverse = square > 0.0 ? 1.0 / square : 0.0;
    const double squares[3] = {
        apart.x * apart.x * inverse, apart.y * apart.y * inverse, apart.z * apart.z * inverse};
    const StepStiffness stiffness = table.step_stiffness(
        particles.species(i), particles.species(j), particles.radius(i), particles.radius(j));
    add(i, squares, particles.radius(i), stiffness, table.rotation_rules());
    add(j, squares, particles.radius(j), stiffness, table.rotation_rules());
}

void StableStep::add_wall(const ParticleState& particles,
                          const ContactTable& table,
                          Index i,
                          Index wall_material,
                          const Vec3& normal) {
    add(i,
        {normal.x * normal.x, normal.y * normal.y, normal.z * normal.z},
        particles.radius(i),
        table.step_stiffness(particles.species(i), wall_material, particles.radius(i), 0.0),
        table.rotation_rules());
}

double StableStep::limit_of(const ParticleState& particles, Index slot) const {
    const double* sum = sums_.data() + 6 * static_cast<std::size_t>(slot);
    const double translation = std::max({sum[0], sum[1], sum[2]}) * particles.inverse_mass(slot);
    const double rotation = std::max({sum[3], sum[4], sum[5]}) * particles.inverse_inertia(slot);
    const double largest = std::max(translation, rotation);
    return largest > 0.0 ? 1.0 / std::sqrt(largest)  // (1)
                         : std::numeric_limits<double>::infinity();
}

double StableStep::limit(const ParticleState& particles) const {
    double smallest = std::numeric_limits<double>::infinity();
    for (const Index slot : list_) {
        smallest = std::min(smallest, limit_of(particles, slot));
    }
    return smallest;
}

double StableStep::single_contact_limit(const ParticleState& particles,
                                        const ContactTable& table,
                                        Index material_count) {
    StableStep one(1);
    double smallest = std::numeric_limits<double>::infinity();
    for (Index slot = 0; slot < particles.size(); ++slot) {
        for (Index material = 0; material < material_count; ++material) {
            one.clear();
            one.add(0,
                    {0.0, 0.0, 1.0},
                    particles.radius(slot),
                    table.step_stiffness(
                        particles.species(slot), material, particles.radius(slot), 0.0),
                    false);
            const double translation = one.sums_[2] * particles.inverse_mass(slot);
            const double rotation = one.sums_[3] * particles.inverse_inertia(slot);
            smallest = std::min(smallest, 1.0 / std::sqrt(std::max(translation, rotation)));
        }
    }
    return smallest;
}

double kinematic_limit(const ParticleState& particles, const Vec3& gravity, double tolerance) {
    double smallest = std::numeric_limits<double>::infinity();
    for (Index slot = 0; slot < particles.size(); ++slot) {
        const double epsilon = tolerance * particles.radius(slot);
        const Vec3 v = particles.velocity(slot);
        const Vec3 a = particles.inverse_mass(slot) * particles.force(slot) + gravity;
        const double speeds[3] = {std::abs(v.x), std::abs(v.y), std::abs(v.z)};
        const double accelerations[3] = {std::abs(a.x), std::abs(a.y), std::abs(a.z)};
        for (int axis = 0; axis < 3; ++axis) {
            const double root =
                std::sqrt(speeds[axis] * speeds[axis] + 2.0 * accelerations[axis] * epsilon);
            if (root > 0.0) {
                smallest = std::min(smallest, 2.0 * epsilon / (speeds[axis] + root));
            }
        }
    }
    return smallest;
}

}  // namespace grainbench
