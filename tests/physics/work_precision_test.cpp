#include "core/verify/work_precision.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace grainbench::verify {
namespace {

double order_of(const WorkCurve& curve, Outcome outcome) {
    return curve.order[static_cast<std::size_t>(outcome)];
}

TEST(WorkPrecision, OrdersAreThoseOfTheScheme) {
    // Leapfrog without damping is of second order, and of third in what an impact gives back, which
    // the phases of first and last touch share evenly. Velocities half a step old in the dashpot
    // make the damped impact one of first order. Slopes over 50 to 800 steps, which the limit at
    // 12800 steps and sixteen phases leave uncertain by some percent.
    for (const WorkCurve& curve : work_precision()) {
        if (!curve.laws.damping_mode) {
            EXPECT_NEAR(order_of(curve, Outcome::restitution), 3.0, 0.1) << curve.laws.name;
            EXPECT_NEAR(order_of(curve, Outcome::overlap), 2.0, 0.1) << curve.laws.name;
            EXPECT_NEAR(order_of(curve, Outcome::energy), 2.0, 0.2) << curve.laws.name;
        } else {
            for (const Outcome outcome : {Outcome::restitution,
                                          Outcome::overlap,
                                          Outcome::sliding,
                                          Outcome::turning,
                                          Outcome::energy}) {
                EXPECT_NEAR(order_of(curve, outcome), 1.0, 0.15) << curve.laws.name;
            }
            // Counted in whole steps.
            EXPECT_NEAR(order_of(curve, Outcome::duration), 1.0, 0.25) << curve.laws.name;
        }
    }
}

TEST(WorkPrecision, EnergyRunsAwayAboveTheLimitOfAStickingPair) {
    EXPECT_NEAR(sticking_pair_limit(), 3.11e-5, 0.005e-5);  // physics reference 10.9
    EXPECT_NEAR(small_pair_contact_time(), 9.15e-5, 0.005e-5);
    const std::vector<StepPoint> points = errors_against_step({1e-5, 2e-5, 4e-5});
    EXPECT_LT(points[0].energy_error, 0.01);
    EXPECT_LT(points[1].energy_error, 0.10);
    EXPECT_GT(points[2].energy_error, 0.25);
    EXPECT_GT(points[2].largest_error, 1.0);  // more energy than came in
}

}  // namespace
}  // namespace grainbench::verify
