#include "core/measure/energy_ledger.hpp"

namespace grainbench {

namespace {

struct Velocities {
    Vec3 linear;
    Vec3 angular;
};

/// Velocities `lead` seconds after the half step, under the present forces.
Velocities velocities_at(const ParticleState& p, const BodyForces& body, Index slot, double lead) {
    return {p.velocity(slot) + lead * body.acceleration(p, slot),
            p.spin(slot) + lead * body.angular_acceleration(p, slot)};
}

Vec3 normal_of(const double* record) {
    return {record[record_normal_x], record[record_normal_y], record[record_normal_z]};
}

Vec3 damping_of(const double* record) {
    return {record[record_damping_x], record[record_damping_y], record[record_damping_z]};
}

Vec3 moment_of(const double* record) {
    return {record[record_moment_x], record[record_moment_y], record[record_moment_z]};
}

/// Of both springs on j.
Vec3 spring_force_of(const double* record) {
    return record[record_normal] * normal_of(record) +
           Vec3{record[record_shear_x], record[record_shear_y], record[record_shear_z]};
}

}  // namespace

std::pair<double, double> kinetic_energies(const ParticleState& particles,
                                           const BodyForces& body,
                                           double timestep) {
    double translation = 0.0;
    double rotation = 0.0;
    for (Index slot = 0; slot < particles.size(); ++slot) {
        if (particles.is_driven(slot)) {
            continue;
        }
        const Velocities v = velocities_at(particles, body, slot, 0.5 * timestep);
        translation += 0.5 * dot(v.linear, v.linear) / particles.inverse_mass(slot);
        rotation += 0.5 * dot(v.angular, v.angular) / particles.inverse_inertia(slot);
    }
    return {translation, rotation};
}

void EnergyLedger::start(const LedgerView& view, double timestep) {
    *this = {};
    const Energies now = energies(view, timestep);
    initial_ = now.kinetic_translation + now.kinetic_rotation + now.potential + now.elastic;
    initial_elastic_ = now.elastic;
}

void EnergyLedger::change_gravity(const ParticleState& particles, const Vec3& change) {
    for (Index slot = 0; slot < particles.size(); ++slot) {
        if (!particles.is_driven(slot)) {
            initial_ -= particles.mass(slot) * dot(change, particles.unwrapped(slot));
        }
    }
}

void EnergyLedger::begin_exchange(const LedgerView& view, double timestep) {
    before_exchange_ = energies(view, timestep);
}

void EnergyLedger::end_exchange(const LedgerView& view, double timestep) {
    const Energies after = energies(view, timestep);
    const auto sum = [](const Energies& e) {
        return e.kinetic_translation + e.kinetic_rotation + e.potential + e.elastic;
    };
    initial_ += sum(after) - sum(before_exchange_);
    initial_elastic_ += after.elastic - before_exchange_.elastic;
}

void EnergyLedger::add_work(const LedgerView& view, double lead, double duration) {
    const ParticleState& p = view.particles;
    const auto touching = view.pairs.touching();
    for (Index t = 0; t < touching.size(); ++t) {
        const double* record = view.pairs.record(t);
        const Index i = view.pairs.objects().i[touching[t].place()];
        const Index j = p.owner(view.pairs.objects().j[touching[t].place()]);
        const Velocities vi = velocities_at(p, view.body, i, lead);
        const Velocities vj = velocities_at(p, view.body, j, lead);
        const Vec3 spin = record[record_lever_i] * vi.angular + record[record_lever_j] * vj.angular;
        const Vec3 relative = vj.linear - vi.linear - cross(spin, normal_of(record));
        dashpot_ -= dot(damping_of(record), relative) * duration;  // (2)
        spring_work_ += dot(spring_force_of(record), relative) * duration;
        spring_work_ += dot(moment_of(record), vj.angular - vi.angular) * duration;
        if (!p.has_driven()) {
            continue;
        }
        const Vec3 force = damping_of(record) + spring_force_of(record);
        const Vec3 normal = normal_of(record);
        const Vec3 at_i = vi.linear + record[record_lever_i] * cross(vi.angular, normal);
        const Vec3 at_j = vj.linear - record[record_lever_j] * cross(vj.angular, normal);
        if (p.is_driven(i)) {
            wall_work_ += (dot(force, at_i) + dot(moment_of(record), vi.angular)) * duration;
        } else if (p.is_driven(j)) {
            wall_work_ -= (dot(force, at_j) + dot(moment_of(record), vj.angular)) * duration;
        }
    }
    for (std::size_t w = 0; w < view.walls.size(); ++w) {
        const WallContacts& contacts = view.wall_contacts[w];
        for (Index t = 0; t < contacts.touching_count(); ++t) {
            const double* record = contacts.record(t);
            const Index i = contacts.particle(t);
            const Vec3 normal = contacts.normal(t);
            const Velocities vi = velocities_at(p, view.body, i, lead);
            const Vec3 at = p.position(i) + record[record_lever_i] * normal;
            const Vec3 wall_velocity = view.walls[w].velocity_at(at);
            const Vec3 relative =
                wall_velocity - vi.linear - cross(record[record_lever_i] * vi.angular, normal);
            dashpot_ -= dot(damping_of(record), relative) * duration;
            spring_work_ += dot(spring_force_of(record), relative) * duration;
            const Vec3& wall_spin = view.walls[w].velocity().angular;
            spring_work_ += dot(moment_of(record), wall_spin - vi.angular) * duration;
            wall_work_ -= dot(contacts.force(t), wall_velocity) * duration;
            wall_work_ -= dot(moment_of(record), wall_spin) * duration;
        }
    }
    if (view.body.local_damping > 0.0) {
        add_local_work(view, lead, duration);
    }
}

void EnergyLedger::add_local_work(const LedgerView& view, double lead, double duration) {
    const ParticleState& p = view.particles;
    const BodyForces undamped{.gravity = view.body.gravity};
    for (Index slot = 0; slot < p.size(); ++slot) {
        if (p.is_driven(slot)) {
            continue;
        }
        const Velocities v = velocities_at(p, view.body, slot, lead);
        const Vec3 lost = view.body.acceleration(p, slot) - undamped.acceleration(p, slot);
        const Vec3 lost_turn =
            view.body.angular_acceleration(p, slot) - undamped.angular_acceleration(p, slot);
        local_ -= dot(lost, v.linear) / p.inverse_mass(slot) * duration;
        local_ -= dot(lost_turn, v.angular) / p.inverse_inertia(slot) * duration;
    }
}

void EnergyLedger::end_step(const LedgerView& view, double timestep) {
    add_work(view, 0.25 * timestep, 0.5 * timestep);
    for (Index t = 0; t < view.pairs.touching().size(); ++t) {
        slip_ += view.pairs.record(t)[record_slip_work];
    }
    for (const WallContacts& contacts : view.wall_contacts) {
        for (Index t = 0; t < contacts.touching_count(); ++t) {
            slip_ += contacts.record(t)[record_slip_work];
        }
    }
}

void EnergyLedger::begin_step(const LedgerView& view, double old_timestep, double timestep) {
    add_work(view, 0.5 * old_timestep + 0.25 * timestep, 0.5 * timestep);
}

Energies EnergyLedger::energies(const LedgerView& view, double timestep) const {
    Energies e;
    std::tie(e.kinetic_translation, e.kinetic_rotation) =
        kinetic_energies(view.particles, view.body, timestep);
    for (Index slot = 0; slot < view.particles.size(); ++slot) {
        if (!view.particles.is_driven(slot)) {
            e.potential -=
                view.particles.mass(slot) * dot(view.body.gravity, view.particles.unwrapped(slot));
        }
    }
    for (Index t = 0; t < view.pairs.touching().size(); ++t) {
        e.elastic += view.pairs.record(t)[record_stored];
    }
    for (const WallContacts& contacts : view.wall_contacts) {
        for (Index t = 0; t < contacts.touching_count(); ++t) {
            e.elastic += contacts.record(t)[record_stored];
        }
    }
    e.dissipated_slip = slip_;
    e.dissipated_dashpot = dashpot_;
    e.dissipated_local = local_;
    e.wall_work = wall_work_;
    e.numerical = initial_elastic_ - spring_work_ - e.elastic - slip_;  // (3)
    e.residual = initial_ + wall_work_ - e.kinetic_translation - e.kinetic_rotation - e.potential -
                 e.elastic - slip_ - dashpot_ - local_ - e.numerical;  // (1)
    return e;
}

void EnergyLedger::save(Archive& archive) const {
    archive.put("energy",
                std::vector<double>{
                    initial_, initial_elastic_, slip_, dashpot_, spring_work_, wall_work_, local_});
}

void EnergyLedger::load(const Archive& archive) {
    const auto& sums = archive.get<double>("energy", 7);
    initial_ = sums[0];
    initial_elastic_ = sums[1];
    slip_ = sums[2];
    dashpot_ = sums[3];
    spring_work_ = sums[4];
    wall_work_ = sums[5];
    local_ = sums[6];
}

}  // namespace grainbench
