/// Whether small motions about the present state grow at a timestep: what makes a step too long.
///
/// Model    v <- v - dt M^-1 (K u + C v),  u <- u + dt v                                    (1)
///          over the contacts that touch, with translations and rotations; iterated from noise
///          until the mode that grows fastest, if any does, outweighs the others.
/// Source   the leapfrog of the engine, its dashpots half a step behind; (1) is the power iteration
///          on it. An undamped mode of frequency w grows from w dt = 2 on (physics reference 2.3).
/// Symbols  u, v small displacements and velocities; M masses and moments of inertia; K, C
/// stiffness
///          and dashpots of the contacts; dt [s].
/// Limits   every contact sticks and stays: slipping, or opening, may bound what (1) says grows.
///          Forces that turn with their normals are left out, of the order of the overlap over the
///          radius. Springs that yield count as stiff as in unloading.
#pragma once

#include "core/contact/contact_table.hpp"
#include "core/contact/pair_contacts.hpp"
#include "core/contact/wall_contacts.hpp"
#include "core/state/particle_state.hpp"

#include <span>
#include <vector>

namespace grainbench {

class SmallMotions {
public:
    SmallMotions(const ParticleState& particles,
                 const PairContacts& pairs,
                 std::span<const WallBody> walls,
                 std::span<const WallContacts> wall_contacts,
                 const ContactTable& table);

    /// Factor by which motions grow per cycle at a step [s]: 1 or a little more or less where they
    /// do not, as beats come and go. Steps of 1.05 times the critical one are found, in scenes of
    /// hundreds of thousands; where dashpots brake the growth, of 1.2 times.
    double growth(double timestep) const;

    /// What growth() reaches only where a mode is beyond its critical step.
    static constexpr double least_growth = 1.2;

private:
    /// Translation and rotation.
    struct Motion {
        Vec3 linear, angular;
    };

    /// Of one contact. A wall, which does not move, has no slot j. Single precision is enough for a
    /// growth that is told from 1.2, and large scenes have millions of these.
    struct Spring {
        Index i = 0;
        Index j = 0;
        float normal[3]{};       ///< [1]
        float arm_i = 0.0F;      ///< [m] from the centre to where friction acts
        float arm_j = 0.0F;      ///< [m]
        float stiff_n = 0.0F;    ///< [N/m]
        float stiff_s = 0.0F;    ///< [N/m]
        float damping_n = 0.0F;  ///< [N s/m]
        float damping_s = 0.0F;  ///< [N s/m]
        float rolling = 0.0F;    ///< [N m]
        float twisting = 0.0F;   ///< [N m]
    };

    /// What touches, before its springs are known.
    struct Touch {
        Index i, j;
        Vec3 normal;
        double arm_i;    ///< [m]
        double arm_j;    ///< [m]
        double overlap;  ///< [m]
    };

    static constexpr Index no_slot = ~Index{0};

    void add(const Touch& touch,
             Index material_j,
             const ParticleState& particles,
             const ContactTable& table);

    std::vector<Motion> noise() const;
    std::vector<Motion> loads(std::span<const Motion> way, std::span<const Motion> velocity) const;
    double size_of(std::span<const Motion> velocity) const;

    std::vector<Spring> springs_;
    std::vector<double> inverse_mass_;     ///< [1/kg] by slot
    std::vector<double> inverse_inertia_;  ///< [1/(kg m^2)] by slot
};

}  // namespace grainbench
