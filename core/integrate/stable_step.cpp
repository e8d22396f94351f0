#include "core/integrate/stable_step.hpp"

#include <algorithm>
#include <limits>

namespace grainbench {

double corrected_stiffness(double stiffness, double damping) {
    const double factor = std::sqrt(1.0 + damping * damping) - damping;
    return stiffness / (factor * factor);  // (3)
}

StableStep::StableStep(Index particle_count) : sums_(6 * static_cast<std::size_t>(particle_count)) {}

void StableStep::clear() {
    std::fill(sums_.begin(), sums_.end(), 0.0);
}

void StableStep::add(Index slot, const Vec3& normal, double lever,
                     const ContactStiffness& stiffness) {
    const double k_n = corrected_stiffness(stiffness.normal, stiffness.normal_damping);
    const double k_s = corrected_stiffness(stiffness.shear, stiffness.shear_damping);
    const double squares[3] = {normal.x * normal.x, normal.y * normal.y, normal.z * normal.z};
    double* sum = sums_.data() + 6 * static_cast<std::size_t>(slot);
    for (int axis = 0; axis < 3; ++axis) {
        sum[axis] += k_n * squares[axis] + k_s * (1.0 - squares[axis]);  // (2)
        sum[3 + axis] += k_s * lever * lever * (1.0 - squares[axis]);
    }
}

void StableStep::add_pair(const ParticleState& particles, const ContactTable& table, Index i,
                          Index j) {
    const Vec3 apart = particles.position(j) - particles.position(i);
    const Vec3 normal = normalized(apart);
    const ContactStiffness stiffness = table.stiffness(
        particles.species(i), particles.species(j), particles.radius(i), particles.radius(j));
    add(i, normal, particles.radius(i), stiffness);
    add(j, normal, particles.radius(j), stiffness);
}

void StableStep::add_wall(const ParticleState& particles, const ContactTable& table, Index i,
                          Index wall_material, const Vec3& normal) {
    add(i, normal, particles.radius(i),
        table.stiffness(particles.species(i), wall_material, particles.radius(i), 0.0));
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
    double largest = 0.0;
    for (Index slot = 0; slot < particles.size(); ++slot) {
        const double* sum = sums_.data() + 6 * static_cast<std::size_t>(slot);
        const double translation =
            std::max({sum[0], sum[1], sum[2]}) * particles.inverse_mass(slot);
        const double rotation =
            std::max({sum[3], sum[4], sum[5]}) * particles.inverse_inertia(slot);
        largest = std::max({largest, translation, rotation});
    }
    return largest > 0.0 ? 1.0 / std::sqrt(largest) : std::numeric_limits<double>::infinity();
}

double StableStep::single_contact_limit(const ParticleState& particles, const ContactTable& table,
                                        Index material_count) {
    StableStep one(1);
    double smallest = std::numeric_limits<double>::infinity();
    for (Index slot = 0; slot < particles.size(); ++slot) {
        for (Index material = 0; material < material_count; ++material) {
            const ContactStiffness s = table.stiffness(particles.species(slot), material,
                                                       particles.radius(slot), 0.0);
            one.clear();
            one.add(0, {0.0, 0.0, 1.0}, particles.radius(slot), s);
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
            const double root = std::sqrt(speeds[axis] * speeds[axis] +
                                          2.0 * accelerations[axis] * epsilon);
            if (root > 0.0) {
                smallest = std::min(smallest, 2.0 * epsilon / (speeds[axis] + root));
            }
        }
    }
    return smallest;
}

}  // namespace grainbench
