#include "core/integrate/small_motions.hpp"

#include <cmath>
#include <random>

namespace grainbench {

namespace {

/// Cycles in which the fastest mode comes forth, and those over which its growth is measured.
constexpr int first_cycles = 8;
constexpr int measured_cycles = 6;

}  // namespace

SmallMotions::SmallMotions(const ParticleState& particles,
                           const PairContacts& pairs,
                           std::span<const WallBody> walls,
                           std::span<const WallContacts> wall_contacts,
                           const ContactTable& table) {
    std::size_t count = pairs.touching().size();
    for (const WallContacts& contacts : wall_contacts) {
        count += contacts.touching_count();
    }
    springs_.reserve(count);
    inverse_mass_.reserve(particles.size());
    inverse_inertia_.reserve(particles.size());
    for (Index slot = 0; slot < particles.size(); ++slot) {
        inverse_mass_.push_back(particles.inverse_mass(slot));
        inverse_inertia_.push_back(particles.inverse_inertia(slot));
    }
    for (const TouchingContact contact : pairs.touching()) {
        const Index i = pairs.objects().i[contact.place()];
        const Index j = pairs.objects().j[contact.place()];
        const Vec3 apart = particles.position(j) - particles.position(i);
        const double distance = norm(apart);
        if (distance > 0.0) {
            const double overlap = particles.radius(i) + particles.radius(j) - distance;
            const double cut = table.lever_cut() * overlap;
            add({.i = particles.owner(i),
                 .j = particles.owner(j),
                 .normal = (1.0 / distance) * apart,
                 .arm_i = particles.radius(i) - cut,
                 .arm_j = particles.radius(j) - cut,
                 .overlap = overlap},
                particles.species(particles.owner(j)),
                particles,
                table);
        }
    }
    for (std::size_t w = 0; w < walls.size(); ++w) {
        const WallContacts& contacts = wall_contacts[w];
        for (Index t = 0; t < contacts.touching_count(); ++t) {
            const Index i = contacts.particle(t);
            const double overlap = particles.radius(i) - contacts.distance(t);
            add({.i = i,
                 .j = no_slot,
                 .normal = contacts.normal(t),
                 .arm_i = particles.radius(i) - table.lever_cut() * overlap,
                 .arm_j = 0.0,
                 .overlap = overlap},
                walls[w].material(),
                particles,
                table);
        }
    }
}

void SmallMotions::add(const Touch& touch,
                       Index material_j,
                       const ParticleState& particles,
                       const ContactTable& table) {
    const bool is_wall = touch.j == no_slot;
    const double inverse_mass = inverse_mass_[touch.i] + (is_wall ? 0.0 : inverse_mass_[touch.j]);
    const double radius_i = particles.radius(touch.i);
    const double radius_j = is_wall ? 0.0 : particles.radius(touch.j);
    const Index material_i = particles.species(touch.i);
    if (inverse_mass == 0.0 || touch.overlap < 0.0) {
        return;  // both are driven, or only cohesion acts
    }
    ContactStiffness stiffness =
        table.stiffness(material_i, material_j, radius_i, radius_j, touch.overlap);
    if (!table.has_friction()) {
        stiffness.shear = 0.0;
    }
    const auto [ratio_n, ratio_s] = table.damping(material_i, material_j);
    const double effective_radius =
        is_wall ? radius_i : radius_i * radius_j / (radius_i + radius_j);
    const double turning = stiffness.shear * effective_radius * effective_radius;
    const auto single = [](double x) { return static_cast<float>(x); };
    springs_.push_back(
        {.i = touch.i,
         .j = touch.j,
         .normal = {single(touch.normal.x), single(touch.normal.y), single(touch.normal.z)},
         .arm_i = single(touch.arm_i),
         .arm_j = single(touch.arm_j),
         .stiff_n = single(stiffness.normal * table.unloading_growth(material_i, material_j)),
         .stiff_s = single(stiffness.shear),
         .damping_n = single(2.0 * ratio_n * std::sqrt(stiffness.normal / inverse_mass)),
         .damping_s = single(2.0 * ratio_s * std::sqrt(stiffness.shear / inverse_mass)),
         .rolling = single(table.rolling_ratio() * turning),
         .twisting = single(table.twisting_ratio() * turning)});
}

double SmallMotions::growth(double timestep) const {
    std::vector<Motion> way(inverse_mass_.size());
    std::vector<Motion> velocity = noise();
    double before = 0.0;
    for (int cycle = 0; cycle < first_cycles + measured_cycles; ++cycle) {
        if (cycle == first_cycles) {
            before = size_of(velocity);
        }
        const std::vector<Motion> load = loads(way, velocity);
        for (std::size_t slot = 0; slot < way.size(); ++slot) {
            velocity[slot].linear += timestep * inverse_mass_[slot] * load[slot].linear;
            velocity[slot].angular += timestep * inverse_inertia_[slot] * load[slot].angular;
            way[slot].linear += timestep * velocity[slot].linear;
            way[slot].angular += timestep * velocity[slot].angular;
        }
    }
    return before > 0.0 ? std::pow(size_of(velocity) / before, 1.0 / measured_cycles) : 1.0;
}

/// Velocities of equal parts of energy, whatever the size of the particle.
std::vector<SmallMotions::Motion> SmallMotions::noise() const {
    std::minstd_rand random(1);
    const auto next = [&] { return static_cast<double>(random()) / 1e9 - 1.0; };
    std::vector<Motion> velocity(inverse_mass_.size());
    for (std::size_t slot = 0; slot < velocity.size(); ++slot) {
        if (inverse_mass_[slot] > 0.0) {
            const double linear = std::sqrt(inverse_mass_[slot]);
            const double angular = std::sqrt(inverse_inertia_[slot]);
            velocity[slot] = {{linear * next(), linear * next(), linear * next()},
                              {angular * next(), angular * next(), angular * next()}};
        }
    }
    return velocity;
}

/// Root of twice the kinetic energy.
double SmallMotions::size_of(std::span<const Motion> velocity) const {
    double sum = 0.0;
    for (std::size_t slot = 0; slot < velocity.size(); ++slot) {
        if (inverse_mass_[slot] > 0.0) {
            const auto& [linear, angular] = velocity[slot];
            sum += dot(linear, linear) / inverse_mass_[slot] +
                   dot(angular, angular) / inverse_inertia_[slot];
        }
    }
    return std::sqrt(sum);
}

/// Forces and torques, -(K u + C v).
std::vector<SmallMotions::Motion> SmallMotions::loads(std::span<const Motion> way,
                                                      std::span<const Motion> velocity) const {
    std::vector<Motion> load(way.size());
    const Motion still{};
    // Relative motion of the surfaces at a contact.
    const auto at_contact =
        [](const Spring& spring, const Vec3& normal, const Motion& of_i, const Motion& of_j) {
            return of_j.linear - of_i.linear -
                   cross(spring.arm_i * of_i.angular + spring.arm_j * of_j.angular, normal);
        };
    for (const Spring& spring : springs_) {
        const bool is_wall = spring.j == no_slot;
        const Motion& way_j = is_wall ? still : way[spring.j];
        const Motion& velocity_j = is_wall ? still : velocity[spring.j];
        const Vec3 normal{spring.normal[0], spring.normal[1], spring.normal[2]};
        const Vec3 shift = at_contact(spring, normal, way[spring.i], way_j);
        const Vec3 rate = at_contact(spring, normal, velocity[spring.i], velocity_j);
        const double shift_n = dot(shift, normal);
        const double rate_n = dot(rate, normal);
        const Vec3 force = double{spring.stiff_n} * shift_n * normal +
                           double{spring.damping_n} * rate_n * normal +
                           spring.stiff_s * (shift - shift_n * normal) +
                           spring.damping_s * (rate - rate_n * normal);
        const Vec3 turn = cross(normal, force);
        const Vec3 bend = way_j.angular - way[spring.i].angular;
        const double twist = dot(bend, normal);
        const Vec3 moment =
            spring.rolling * (bend - twist * normal) + double{spring.twisting} * twist * normal;
        load[spring.i].linear += force;
        load[spring.i].angular += spring.arm_i * turn + moment;
        if (!is_wall) {
            load[spring.j].linear -= force;
            load[spring.j].angular += spring.arm_j * turn - moment;
        }
    }
    return load;
}

}  // namespace grainbench
