/// Touching contacts one by one with what they bear, from the records that the last cycle left.
#pragma once

#include "core/measure/measurement.hpp"

namespace grainbench {

/// Body i is a particle; j a particle or a wall.
struct ContactLoad {
    static constexpr Index no_wall = ~Index{0};

    Index i = 0;            ///< slot
    Index j = 0;            ///< slot, where there is no wall; of the owner of an image
    Index wall = no_wall;   ///< index among the walls
    Vec3 normal{};          ///< [1] unit vector from i to j
    Vec3 point{};           ///< [m] contact point, in the middle of the overlap
    Vec3 branch{};          ///< [m] from the centre of i to that of j, or to the contact point
    Vec3 force{};           ///< [N] on j: springs, cohesion and dashpots
    Vec3 shear{};           ///< [N] on j, of the shear spring
    Vec3 end{};             ///< [m] centre of j or of its image, or the closest point of the wall
    double overlap = 0.0;   ///< [m]
    double pressing = 0.0;  ///< [N] of the normal spring, less the attraction
};

/// Adds what a record says to a contact whose bodies are known.
inline ContactLoad load_of(const MeasureView& view, ContactLoad contact, const double* record) {
    const auto vector = [&](Index first) {
        return Vec3{record[first], record[first + 1], record[first + 2]};
    };
    const ParticleState& p = view.particles;
    const double to_point = p.radius(contact.i) - 0.5 * contact.overlap;
    const double beyond =
        contact.wall == ContactLoad::no_wall ? p.radius(contact.j) - 0.5 * contact.overlap : 0.0;
    contact.normal = vector(record_normal_x);
    contact.point = p.position(contact.i) + to_point * contact.normal;
    contact.branch = (to_point + beyond) * contact.normal;
    contact.pressing = record[record_normal];
    contact.shear = vector(record_shear_x);
    contact.force = contact.pressing * contact.normal + contact.shear + vector(record_damping_x);
    return contact;
}

/// Calls visit(ContactLoad) for all touching contacts: pairs, then wall by wall.
template <class Visit>
void for_each_contact(const MeasureView& view, Visit&& visit) {
    const ParticleState& p = view.particles;
    const auto touching = view.pairs.touching();
    for (Index t = 0; t < touching.size(); ++t) {
        ContactLoad contact;
        const Index row = view.pairs.objects().j[touching[t].place()];
        contact.i = view.pairs.objects().i[touching[t].place()];
        contact.j = p.owner(row);
        const Vec3 apart = p.box().shortest(p.position(row) - p.position(contact.i));
        contact.end = p.position(contact.i) + apart;
        contact.overlap = p.radius(contact.i) + p.radius(contact.j) - norm(apart);
        visit(load_of(view, contact, view.pairs.record(t)));
    }
    for (std::size_t w = 0; w < view.walls.size(); ++w) {
        const WallContacts& contacts = view.wall_contacts[w];
        for (Index t = 0; t < contacts.touching_count(); ++t) {
            ContactLoad contact;
            contact.i = contacts.particle(t);
            contact.wall = static_cast<Index>(w);
            contact.end = contacts.point(p, t);
            contact.overlap = p.radius(contact.i) - contacts.distance(t);
            visit(load_of(view, contact, contacts.record(t)));
        }
    }
}

}  // namespace grainbench
