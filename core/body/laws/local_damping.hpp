/// Damping of every particle against its own motion, for states of rest that are to come soon.
///
/// Model    F_d = -alpha |F| sign(v), component by component, and alike for moments       (1)
/// Source   Cundall 1987; PFC documentation, local damping (physics reference 3.3).
/// Symbols  F sum of all forces on a particle, weight included [N]; v its velocity [m/s]; alpha
///          coefficient [1].
/// Signs    F_d has the sign opposite to v; where v is 0 there is none.
/// History  none.
/// Limits   0 <= alpha < 1. Falls at g (1 - alpha), swings down by sqrt((1 - alpha) / (1 + alpha))
///          each half cycle at any frequency. It acts in free flight too and does not conserve
///          momentum: not for flow.
#pragma once

#include "core/describe.hpp"

#include <string_view>
#include <tuple>

namespace grainbench {

struct LocalDamping {
    double coefficient = 0.7;  ///< [1]

    static constexpr auto fields() {
        return std::tuple{required(&LocalDamping::coefficient,
                                   "coefficient",
                                   "1",
                                   Domain{.low = 0.0, .high = 1.0, .high_open = true},
                                   "part of the force on a particle that acts against its motion")};
    }

    /// Force, or its acceleration, after (1).
    static double damped(double coefficient, double force, double velocity) {
        const double lost = coefficient * (force < 0.0 ? -force : force);
        return velocity > 0.0 ? force - lost : velocity < 0.0 ? force + lost : force;
    }
};

}  // namespace grainbench
