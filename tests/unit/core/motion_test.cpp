#include "core/walls/motion.hpp"

#include "core/error.hpp"

#include "tests/unit/core/wall_support.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace grainbench {
namespace {

using Nodes = std::vector<std::pair<double, double>>;

/// Displacement up to node `last` [m]; exact for a piecewise linear speed.
double displacement(const Nodes& nodes, std::size_t last) {
    double sum = 0.0;
    for (std::size_t k = 1; k <= last; ++k) {
        sum +=
            0.5 * (nodes[k].second + nodes[k - 1].second) * (nodes[k].first - nodes[k - 1].first);
    }
    return sum;
}

double speed_at(const MotionEvaluator& motion, double t) {
    return motion.at(t).linear.z;
}

MotionEvaluator shaking(double frequency, double amplitude, double start = 0.0) {
    return {SmoothedSquareMotion{.frequency = frequency, .amplitude = amplitude}, start};
}

TEST(SmoothedSquare, HasTheNodesOfTheExample) {
    const Nodes nodes = smoothed_square_table(10.0, 0.35);
    ASSERT_EQ(nodes.size(), 202U);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        const std::size_t j = k <= 100 ? k : k - 1;  // t = T / 2 occurs twice
        EXPECT_NEAR(nodes[k].first, 0.1 * static_cast<double>(j) / 200.0, round_off(2, 0.1));
        // Mirror of the first quarter, then of the first half with the sign turned.
        const std::size_t in_half = j <= 100 ? j : 200 - j;
        const std::size_t in_quarter =
            in_half < 50 ? in_half : 99 - std::min<std::size_t>(in_half, 99);
        const double rise =
            0.35 / (1.0 + std::exp(-130.0 * (static_cast<double>(in_quarter) / 200.0 - 0.055)));
        const double expected = in_quarter == 0 ? 0.0 : k <= 100 ? rise : -rise;
        EXPECT_NEAR(nodes[k].second, expected, round_off(8, 0.35)) << "node " << k;
    }
}

TEST(SmoothedSquare, IsZeroWhereTheFlanksEnd) {
    const MotionEvaluator motion = shaking(10.0, 0.35);
    for (const double s : {0.0, 0.495, 0.5, 0.505, 1.0}) {
        // The flank rises by 0.035 A in 1 / 200 T, so a rounding of t gives 7 A roundings of speed.
        EXPECT_NEAR(speed_at(motion, 0.1 * s), 0.0, round_off(20, 0.35)) << "s = " << s;
    }
}

TEST(SmoothedSquare, ReachesHalfItsAmplitudeInTheMiddleOfEachFlank) {
    const MotionEvaluator motion = shaking(100.0, 1.2);
    EXPECT_NEAR(speed_at(motion, 0.01 * 0.055), 0.6, 1e-12);
    EXPECT_NEAR(speed_at(motion, 0.01 * 0.440), 0.6, 1e-12);
    EXPECT_NEAR(speed_at(motion, 0.01 * 0.560), -0.6, 1e-12);
    EXPECT_NEAR(speed_at(motion, 0.01 * 0.945), -0.6, 1e-12);
}

TEST(SmoothedSquare, HasTheStrokeAndAccelerationOfTheExample) {
    // Published to 5 digits: half of the last one.
    const Nodes slow = smoothed_square_table(10.0, 0.35);
    EXPECT_NEAR(displacement(slow, 100), 13.474e-3, 0.5e-6);
    EXPECT_NEAR(displacement(smoothed_square_table(100.0, 1.2), 100), 4.6198e-3, 0.5e-7);

    double peak = 0.0;
    double steepest = 0.0;
    for (std::size_t k = 1; k < slow.size(); ++k) {
        peak = std::max(peak, slow[k].second);
        if (slow[k].first > slow[k - 1].first) {
            steepest = std::max(steepest,
                                std::abs(slow[k].second - slow[k - 1].second) /
                                    (slow[k].first - slow[k - 1].first));
        }
    }
    EXPECT_NEAR(steepest, 109.91, 0.005);
    EXPECT_NEAR(peak, 0.35 * 0.99999999998, 0.35e-11);
}

TEST(SmoothedSquare, ReturnsToWhereItStarted) {
    for (const double frequency : {3.0, 7.0, 10.0, 49.0, 100.0}) {
        const Nodes nodes = smoothed_square_table(frequency, 0.35);
        EXPECT_EQ(nodes.back().first, 1.0 / frequency);
        EXPECT_NEAR(displacement(nodes, 201), 0.0, round_off(202, 0.35 / frequency));
    }
}

TEST(SmoothedSquare, RepeatsFromItsOwnStart) {
    const double start = 20.000013;
    const MotionEvaluator motion = shaking(100.0, 1.2, start);
    EXPECT_EQ(speed_at(motion, start), 0.0);
    for (const double s : {0.03, 0.2, 0.44, 0.7, 0.97}) {
        const double first = speed_at(motion, start + 0.01 * s);
        // t ~ 40 s in doubles leaves 7e-15 s; the flank changes by 3768 m/s^2.
        EXPECT_NEAR(speed_at(motion, start + 0.01 * (1999.0 + s)), first, 4.0 * 3768.0 * 7e-15);
    }
}

TEST(Table, HoldsItsLastSpeedOrRepeats) {
    TableMotion table{.times = {0.0, 1.0, 1.0, 3.0}, .speeds = {1.0, 2.0, -1.0, 5.0}};
    const MotionEvaluator held(table, 10.0);
    EXPECT_EQ(speed_at(held, 10.5), 1.5);
    EXPECT_EQ(speed_at(held, 11.0), -1.0);  // a jump takes its later value
    EXPECT_EQ(speed_at(held, 12.0), 2.0);
    EXPECT_EQ(speed_at(held, 13.0), 5.0);
    EXPECT_EQ(speed_at(held, 99.0), 5.0);
    table.repeat = true;
    const MotionEvaluator repeated(table, 10.0);
    EXPECT_EQ(speed_at(repeated, 13.0), 5.0);  // the period must be exceeded to start anew
    EXPECT_EQ(speed_at(repeated, 13.5), 1.5);
    EXPECT_EQ(speed_at(repeated, 16.0), 5.0);
    EXPECT_EQ(speed_at(repeated, 17.0 + 3.0 * 1000), -1.0);
}

TEST(Table, RefusesWhatIsNoFunctionOfTime) {
    EXPECT_THROW(MotionEvaluator(TableMotion{.times = {0.0, 1.0}, .speeds = {1.0}}, 0.0), Error);
    EXPECT_THROW(MotionEvaluator(TableMotion{.times = {0.1, 1.0}, .speeds = {1.0, 1.0}}, 0.0),
                 Error);
    EXPECT_THROW(MotionEvaluator(TableMotion{.times = {0.0, 2.0, 1.0}, .speeds = {1, 1, 1}}, 0.0),
                 Error);
    EXPECT_THROW(MotionEvaluator(TableMotion{.times = {0.0}, .speeds = {1.0}, .repeat = true}, 0.0),
                 Error);
}

TEST(Sinusoid, FollowsItsPhaseFromTheStart) {
    const MotionEvaluator motion(
        SinusoidMotion{.velocity = {0.0, 2.0, 1.0}, .frequency = 5.0, .phase = pi / 6.0}, 3.0);
    EXPECT_NEAR(motion.at(3.0).linear.y, 1.0, round_off(4, 2.0));
    EXPECT_NEAR(motion.at(3.0 + 1.0 / 15.0).linear.z, 0.5, 1e-13);  // phase 150 degrees; t near 3 s
}

TEST(Rotation, TurnsAboutItsPointWithUnitAxis) {
    const MotionEvaluator motion(
        RotationMotion{.point = {1.0, 2.0, 3.0}, .axis = {0.0, 0.0, -4.0}, .rate = 2.5}, 0.0);
    EXPECT_EQ(motion.centre(), (Vec3{1.0, 2.0, 3.0}));
    EXPECT_EQ(motion.at(7.0).linear, Vec3{});
    EXPECT_EQ(motion.at(7.0).angular, (Vec3{0.0, 0.0, -2.5}));
    EXPECT_THROW(MotionEvaluator(RotationMotion{.axis = {}, .rate = 1.0}, 0.0), Error);
}

TEST(Motion, KeepsConstantAndFixedWallsApart) {
    const MotionEvaluator constant(ConstantMotion{.velocity = {1.0, 2.0, 3.0}}, 5.0);
    EXPECT_EQ(constant.at(9.0).linear, (Vec3{1.0, 2.0, 3.0}));
    EXPECT_FALSE(constant.is_fixed());
    EXPECT_TRUE(MotionEvaluator(FixedMotion{}, 0.0).is_fixed());
    EXPECT_EQ(MotionEvaluator(FixedMotion{}, 0.0).at(1.0).linear, Vec3{});
}

}  // namespace
}  // namespace grainbench
