/// What the step does to the energy: of one damped contact over all damping ratios and steps, and
/// of a shaken bed over steps.
///
/// Model    m x'' = -k x - 2 beta sqrt(m k) x', x from where weight and spring balance          (1)
///          stable for dt < (sqrt(1 + beta^2) - beta) 2 sqrt(m / k)                             (2)
/// Source   (2) follows from a dashpot that acts on the velocity of half a step before, put into
/// the
///          characteristic polynomial of the leapfrog (share/doc/notation.md).
/// Symbols  x [m], beta damping ratio [1], m [kg], k [N/m]
/// Limits   a contact that stays closed: (1) is linear.
#pragma once

#include <vector>

namespace grainbench::verify {

/// One ball that swings on a plane, never leaving it while it is stable.
struct MapPoint {
    double damping = 0.0;       ///< [1]
    double step = 0.0;          ///< over the undamped critical step [1]
    double energy_error = 0.0;  ///< largest |E - exact E| over the energy at the start [1]
    bool grows = false;         ///< its energy rises, or stays where it should decay
};

std::vector<MapPoint> stability_map(const std::vector<double>& dampings,
                                    const std::vector<double>& steps);

/// (2) over its value without damping.
double critical_step_ratio(double damping);

/// A bed of 125 balls, thrown about by its box.
struct BedPoint {
    double timestep = 0.0;  ///< [s]
    double energy_error =
        0.0;  ///< |made or lost by the integrator| over what friction and dashpots
              ///< took, the mean of two beds [1]; NaN if a guard stopped one
};

std::vector<BedPoint> shaken_bed_errors(const std::vector<double>& timesteps);

/// The step that is chosen for such a bed with a safety factor of 0.8, the mean of a run [s].
double shaken_bed_automatic_step();

}  // namespace grainbench::verify
