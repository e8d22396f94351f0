// Balls and a layer of beads on a belt: presets/scenes/conveyor.json and conveyor-layer.json.

#include "tests/physics/scene_history.hpp"

#include <gtest/gtest.h>

#include <cstdio>

namespace grainbench {
namespace {

constexpr double belt_speed = 0.7;  // m/s
constexpr double friction = 0.3;
constexpr double gravity = 9.81;  // m/s^2

TEST(Conveyor, BallsFromRestRollAtTwoSeventhsOfTheBelt) {
    const auto run = test::run_presets({{"conveyor", {}}});
    // Sliding: v = mu g t, R w = 5/2 mu g t, until v + R w is the speed of the belt: any radius.
    const double end_of_sliding = 2.0 * belt_speed / (7.0 * friction * gravity);
    for (const ParticleFrame& frame : run[0].frames) {
        for (std::size_t n = 0; n < frame.size(); ++n) {
            const double exact = friction * gravity * std::min(frame.time, end_of_sliding);
            EXPECT_NEAR(frame.velocity[n].x, exact, 1e-3 * belt_speed)
                << "radius " << frame.radius[n] << " at " << frame.time;
        }
    }
}

TEST(Conveyor, LayerIsCarriedAtTheSpeedOfTheBelt) {
    const test::SceneHistory run = test::run_presets({{"conveyor-layer", {}}})[0];
    constexpr double started = 0.1;  // s
    for (const ParticleFrame& frame : run.frames) {
        double mean = 0.0;
        for (const Vec3& velocity : frame.velocity) {
            mean += velocity.x / static_cast<double>(frame.size());
        }
        std::printf("%.2f s: %.4f of the speed of the belt\n", frame.time, mean / belt_speed);
        // Friction alone drives the layer, with at most mu times its weight; the 1 % is what the
        // settling leaves in the load.
        const double most = friction * gravity * std::max(frame.time - started, 0.0);
        EXPECT_LE(mean, most + 0.01 * belt_speed);
    }
    // What moves as the belt does is driven no more, and nothing slows it down.
    for (const Vec3& velocity : run.frames.back().velocity) {
        EXPECT_NEAR(velocity.x, belt_speed, 0.01 * belt_speed);
    }
}

}  // namespace
}  // namespace grainbench
