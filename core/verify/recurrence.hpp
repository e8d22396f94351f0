/// The time stepping of the engine written out a second time, for one ball above a floor: what a
/// bounce must give to round-off at any step, however coarse.
///
/// Model    v <- v + (F/m - g) (dt_old + dt)/2;  z <- z + v dt                              (1)
///          F = k d - c v for d = R - z >= 0, cut at 0 where tension is not allowed           (2)
/// Source   physics reference 3.2 (leapfrog, velocities at the half step) and 1.4, 1.6.
/// Symbols  z height of the centre over the floor [m]; v velocity at the half step [m/s];
///          c = 2 beta sqrt(m k) [kg/s].
#pragma once

namespace grainbench::verify {

struct BounceRecurrence {
    double mass = 0.0;       ///< [kg]
    double radius = 0.0;     ///< [m]
    double stiffness = 0.0;  ///< [N/m]
    double damping = 0.0;    ///< [1] beta
    bool tension = true;     ///< the dashpot may pull
    double gravity = 0.0;    ///< [m/s^2] downward, positive
    double height = 0.0;     ///< [m]
    double velocity = 0.0;   ///< [m/s] at the half step before `height`; at first at the same time
    double force = 0.0;      ///< [N]
    double timestep = 0.0;   ///< [s] of the last step; 0 before the first

    void step(double dt);

    bool touches() const { return height <= radius; }

    /// At the full step [m/s].
    double full_velocity() const { return velocity + 0.5 * timestep * (force / mass - gravity); }
};

}  // namespace grainbench::verify
