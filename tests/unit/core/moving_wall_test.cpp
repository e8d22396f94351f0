/// Where walls are after a motion, as frames show them.
#include "core/simulation.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace grainbench {
namespace {

Scene lone_box(const WallMotion& motion, double still, double moving) {
    Scene scene;
    scene.particles.species = {{"ball", 0.003, 1500.0}};
    scene.walls = {{.name = "box",
                    .shape = BoxShape{{0.0, 0.0, 0.0}, {2.0, 1.0, 1.0}},
                    .motion = FixedMotion{},
                    .material = {}}};
    scene.contact.stiffness = ConstantStiffness::Params{.normal = 1e4, .shear = 0.0};
    scene.timestep = FixedTimestep{1e-4};
    Stage first;
    first.duration = still;
    Stage second;
    second.duration = moving;
    second.motions = {{"box", motion}};
    scene.stages = {first, second};
    return scene;
}

/// The corner that began at the far end of x.
Vec3 far_corner(const Scene& scene) {
    const std::vector<Vec3> before = Simulation(scene, 0).wall_frame().walls.at(0).points;
    const auto corner = static_cast<std::size_t>(
        std::find(before.begin(), before.end(), Vec3{2.0, 0.0, 0.0}) - before.begin());
    Simulation simulation(scene, 0);
    Observer nobody;
    while (!simulation.advance(1U << 20U, nobody)) {
    }
    return simulation.wall_frame().walls.at(0).points.at(corner);
}

TEST(MovingWall, BeginsItsMotionWithTheStage) {
    const double frequency = 10.0;
    const Vec3 end = far_corner(
        lone_box(SinusoidMotion{.velocity = {0.0, 0.0, 0.3}, .frequency = frequency}, 0.013, 0.05));
    // Half a period of the sine, by sums over 500 steps from the left: their error for a function
    // that is zero at both ends is (pi / 500)^2 / 12 of it, and a step too many adds less than
    // 1e-6 of it.
    const double way = 0.3 / (pi * frequency);
    EXPECT_NEAR(end.z, way, 1e-5 * way);
}

TEST(MovingWall, TurnsAboutThePointGiven) {
    const Vec3 end = far_corner(lone_box(
        RotationMotion{.point = {1.0, 0.0, 0.0}, .axis = {0.0, 0.0, 1.0}, .rate = 0.5 * pi / 0.1},
        0.0,
        0.1));
    // A quarter turn in 1000 steps, each with some ten roundings of numbers of about 1; the last
    // step may be one more, by rounding of the time.
    const double step = 0.5 * pi / 1000.0;
    EXPECT_NEAR(end.x, 1.0, 1.01 * step);
    EXPECT_NEAR(end.y, 1.0, 1e-4);
    EXPECT_NEAR(norm(end - Vec3{1.0, 0.0, 0.0}), 1.0, 1e-11);
}

}  // namespace
}  // namespace grainbench
