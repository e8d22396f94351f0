// Slopes that beads hold: presets/scenes/poured-heap.json and rotating-drum.json. Slow: a minute of
// processor time.

#include "tests/physics/scene_history.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

namespace grainbench {
namespace {

constexpr double degrees = 180.0 / std::numbers::pi;

/// Angle [deg] of the sides of a heap on a square plate: the straight line through the mean height
/// of its surface by the distance from the nearest edge. Heights are those of the highest beads
/// over squares of a bead diameter; the foot and the top of the heap are left out.
double side_angle(const ParticleFrame& frame) {
    constexpr double half = 0.04;     // m, of the plate
    constexpr double square = 0.004;  // m
    std::map<std::pair<int, int>, double> top;
    for (std::size_t n = 0; n < frame.size(); ++n) {
        const Vec3& at = frame.position[n];
        double& highest = top[{static_cast<int>(std::floor((at.x + half) / square)),
                               static_cast<int>(std::floor((at.y + half) / square))}];
        highest = std::max(highest, at.z + frame.radius[n]);
    }
    std::vector<double> inward, height;
    for (const auto& [place, level] : top) {
        const double x = (place.first + 0.5) * square - half;
        const double y = (place.second + 0.5) * square - half;
        const double distance = half - std::max(std::abs(x), std::abs(y));
        if (distance > 0.004 && distance < 0.032) {
            inward.push_back(distance);
            height.push_back(level);
        }
    }
    return degrees * std::atan(test::line_through(inward, height).slope);
}

TEST(PouredHeap, IsSteeperWithRollingResistanceAndWithCohesion) {
    // Some ten weights of a bead.
    const std::string cohesion =
        R"(/contact/cohesion={"law":"linear_cohesion","force":8.2e-3,"reach":2e-5})";
    const std::vector<test::SceneHistory> runs =
        test::run_presets({{"poured-heap", {"/contact/rolling/coefficient=0"}},
                           {"poured-heap", {}},
                           {"poured-heap", {cohesion}}});
    const double rolling_free = side_angle(runs[0].frames.back());
    const double rolling_resists = side_angle(runs[1].frames.back());
    const double cohesive = side_angle(runs[2].frames.back());
    std::printf(
        "side at %.1f degrees without rolling resistance, %.1f with it, %.1f with cohesion\n",
        rolling_free,
        rolling_resists,
        cohesive);
    // A row of beads more or less on a side of ten rows is 2 degrees.
    EXPECT_GT(rolling_resists, rolling_free + 2.0);
    EXPECT_GT(cohesive, rolling_resists + 2.0);
}

TEST(RotatingDrum, TurnsAgainstTheWeightOfWhatLeansUphill) {
    const test::SceneHistory run =
        test::run_presets({{"rotating-drum", {"/observables/wall_forces={}"}}})[0];
    constexpr double steady = 1.3;  // s: one second of turning
    double lever = 0.0, depth = 0.0, weight = 0.0;
    int frames = 0;
    for (const ParticleFrame& frame : run.frames) {
        if (frame.time > steady) {
            weight = 0.0;
            for (std::size_t n = 0; n < frame.size(); ++n) {
                const double mass =
                    2500.0 * 4.0 / 3.0 * std::numbers::pi * std::pow(frame.radius[n], 3);
                lever += mass * frame.position[n].x;
                depth -= mass * frame.position[n].z;
                weight += 9.81 * mass;
            }
            ++frames;
        }
    }
    lever *= 9.81 / weight / frames;
    depth *= 9.81 / weight / frames;
    const double torque = run.mean("drum.torque_y", steady, 1e9);
    std::printf("torque over weight %.3f mm, lever of the mass %.3f mm, surface at %.1f degrees\n",
                1e3 * torque / weight,
                1e3 * lever,
                degrees * std::atan(std::abs(lever) / depth));
    // The bed neither gains nor loses spin in the mean: the drum carries its weight at its lever.
    EXPECT_NEAR(std::abs(torque) / weight, std::abs(lever), 0.02 * std::abs(lever));
}

}  // namespace
}  // namespace grainbench
