/// Estimate of the stable step from sums over the contact objects of each particle, and the limits
/// that the timestep schemes put on it.
///
/// Model    dt_i = min over axes of sqrt(m / k_i), sqrt(I / kappa_i)                        (1)
///          k_i = sum K_n n_i^2 + K_s (1 - n_i^2);  kappa_i = sum K_s R^2 (1 - n_i^2)       (2)
///          with rolling and twisting stiffness rho, tau times K_s R^2, K_s R^2 (1 - n_i^2) becomes
///          K_s R^2 ((1 + rho) (1 - n_i^2) + tau n_i^2)
///          K = k / (sqrt(1 + beta^2) - beta)^2          (3), in ContactTable::step_stiffness
/// Source   PFC documentation, timestep determination; Belytschko 1983 for (3)
///          (physics reference 2.2). Departs from it in the normals, which are those of the last
///          change of the contacts that count, not of every cycle.
/// Symbols  m, I inertial mass [kg] and moment, 2/5 m R^2 [kg m^2]; k_n, k_s [N/m]; R lever arm
/// [m];
///          beta damping ratio [1]; n_i component i of the contact normal [1].
/// Limits   diagonal estimate: all contacts that count do so alike, touching or not; no proof of
///          stability.
#pragma once

#include "core/body/body_forces.hpp"
#include "core/contact/contact_table.hpp"
#include "core/parallel/workers.hpp"
#include "core/state/particle_state.hpp"

namespace grainbench {

class StableStep {
public:
    StableStep() = default;

    /// Starts new sums; then let every contact that counts add to sums().
    /// \param rotation_rules no contact can make translation the limit: its sums are left out
    /// \param rolling, twisting stiffnesses of moments over K_s R^2 [1]
    void clear(const ParticleState& particles,
               bool rotation_rules,
               double rolling,
               double twisting,
               const Workers& workers);

    /// Hands what contacts added to images of particles to their owners.
    void fold_images(const ParticleState& particles);

    StepSums sums();

    /// Smallest dt_i of (1) [s]; infinite without contacts.
    /// \param keeps whether limit_of() will be asked
    double limit(ParticleState& particles,
                 bool keeps,
                 const Kernels& kernels,
                 const Workers& workers);

    /// dt_i of one particle [s]; infinite without contacts.
    double limit_of(const ParticleState& particles, Index slot) const;

    /// Step of one lone contact of the stiffest and lightest kind [s]: where an automatic step
    /// starts from while nothing is in contact.
    static double single_contact_limit(const ParticleState& particles,
                                       const ContactTable& table,
                                       Index material_count);

private:
    Column<double> shear_;   ///< packet by particle: sum of K_s n^2 per axis, sum of K_s [N/m]
    Column<double> normal_;  ///< packet by particle: sum of K_n n^2 per axis [N/m]; may be empty
    bool are_zero_ = false;  ///< both
    std::vector<double> largest_;  ///< by slab: of k/m and kappa/I [1/s^2]
    double rolling_ = 0.0;         ///< [1]
    double twisting_ = 0.0;        ///< [1]
};

/// Largest dt for which no particle moves by more than its tolerance along an axis [s]:
/// |v| dt + a dt^2 / 2 <= epsilon (physics reference 2.4, conservative in the signs).
/// \param tolerance [1] epsilon over the radius
double kinematic_limit(const ParticleState& particles, const BodyForces& body, double tolerance);

}  // namespace grainbench
