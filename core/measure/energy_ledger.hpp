/// Energy ledger of one realisation: what walls put in, what is stored, what is dissipated and by
/// what.
///
/// Model    kinetic + potential + elastic + slip + dashpot + local damping + numerical
///          = initial + wall work                                                            (1)
///          work of a force F over a cycle: F . [(v- + v) dt_old + (v + v+) dt_new] / 4       (2)
///          numerical = -(work of the springs) - elastic - slip                              (3)
/// Source   (2) is the exact work of a force in the leapfrog with a step that changes; physics
///          reference 3.2 for the scheme. The ledger has no other source.
/// Symbols  v-, v+ velocities at the half steps before and after the force is evaluated, v their
///          full-step value [m/s]; dt_old, dt_new steps before and after [s].
/// Signs    wall work is positive where walls, or driven groups, put energy into the other
/// particles.
///          Driven particles are no part of the system: they count as walls.
/// Limits   `numerical` is energy that the integrator loses, mostly where contacts open and close
///          within a step: a spring that acts for a whole step has not been deformed for a whole
///          step. It falls with the step. `residual`, what (1) leaves, is round-off and
///          dt^2/8 times gravity times the present contact forces (the potential goes by positions,
///          the work of gravity by full-step velocities): each side is summed on its own, so that a
///          wrong force, lever or wall velocity shows. Where a particle goes while it touches
///          others, half a step of the work of its contacts stays in `residual`.
#pragma once

#include "core/body/body_forces.hpp"
#include "core/contact/pair_contacts.hpp"
#include "core/contact/wall_contacts.hpp"

#include <span>

namespace grainbench {

/// All in joule; differences of potential only have a meaning.
struct Energies {
    double kinetic_translation = 0.0;
    double kinetic_rotation = 0.0;
    double potential = 0.0;
    double elastic = 0.0;
    double dissipated_slip = 0.0;
    double dissipated_dashpot = 0.0;
    double dissipated_local = 0.0;
    double wall_work = 0.0;
    double numerical = 0.0;
    double residual = 0.0;
};

/// What the ledger looks at; all at one instant.
struct LedgerView {
    const ParticleState& particles;
    const PairContacts& pairs;
    std::span<const WallBody> walls;
    std::span<const WallContacts> wall_contacts;
    BodyForces body;
};

class EnergyLedger {
public:
    /// Takes the present energy as the initial one.
    void start(const LedgerView& view, double timestep);

    /// Gravity is another from here on: what that adds to the potential is no gain.
    void change_gravity(const ParticleState& particles, const Vec3& change);

    /// Call before and after particles come or go: what they bring and take is no loss.
    void begin_exchange(const LedgerView& view, double timestep);
    void end_exchange(const LedgerView& view, double timestep);

    /// First half of (2), once the forces at the end of a step are known.
    void end_step(const LedgerView& view, double timestep);

    /// Second half of (2), before the next step moves the particles; walls have their new velocity.
    void begin_step(const LedgerView& view, double old_timestep, double timestep);

    /// At the end of a step of this length.
    Energies energies(const LedgerView& view, double timestep) const;

    void save(Archive& archive) const;
    void load(const Archive& archive);

private:
    void add_work(const LedgerView& view, double lead, double duration);
    void add_local_work(const LedgerView& view, double lead, double duration);

    double initial_ = 0.0;
    double initial_elastic_ = 0.0;
    Energies before_exchange_;
    double slip_ = 0.0;
    double dashpot_ = 0.0;
    double local_ = 0.0;
    double spring_work_ = 0.0;
    double wall_work_ = 0.0;
};

/// Kinetic energies at the full step that ends a step of this length [J]; of what is not driven.
std::pair<double, double> kinetic_energies(const ParticleState& particles,
                                           const BodyForces& body,
                                           double timestep);

}  // namespace grainbench
