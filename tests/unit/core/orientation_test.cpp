// How particles have turned, where the output asks for it.
#include "core/simulation.hpp"

#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace grainbench::test {
namespace {

/// A ball that spins in free flight for 0.1 s.
Scene spinning_ball(const Vec3& spin) {
    Scene scene;
    scene.particles.species = {{.name = "ball", .radius = 0.01, .density = 1000.0}};
    scene.particles.insertion.emplace_back(
        ListInsertion{{{.species = "ball", .position = {}, .angular_velocity = spin}}});
    scene.contact.stiffness = ConstantStiffness::Params{.normal = 1e4};
    scene.timestep = FixedTimestep{.value = 1e-5};
    Stage stage;
    stage.duration = 0.1;
    scene.stages.push_back(stage);
    scene.output.orientation = true;
    return scene;
}

TEST(Orientation, OfAFreeBallIsItsSpinTimesTheTime) {
    const Vec3 spin{30.0, -40.0, 120.0};
    Simulation simulation(spinning_ball(spin), 0);
    Observer nobody;
    simulation.advance(1U << 30U, nobody);
    const auto q = simulation.particle_frame().orientation.at(0);
    const double angle = norm(spin) * simulation.time();
    const Vec3 axis = normalized(spin);
    // The scheme falls short by (w dt)^2 / 12 of the angle, 1.4e-7.
    EXPECT_NEAR(q[0], std::cos(0.5 * angle), 2e-6);
    EXPECT_NEAR(q[1], axis.x * std::sin(0.5 * angle), 2e-6);
    EXPECT_NEAR(q[2], axis.y * std::sin(0.5 * angle), 2e-6);
    EXPECT_NEAR(q[3], axis.z * std::sin(0.5 * angle), 2e-6);
    EXPECT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1.0, 1e-14);
}

TEST(Orientation, OfABallThatRollsIsTheWayOverTheRadius) {
    // Rolls without slip along x: about y, by x / R.
    Scene scene = spinning_ball({0.0, 20.0, 0.0});
    auto& ball = std::get<ListInsertion>(scene.particles.insertion[0]).particles[0];
    ball.position = {0.0, 0.0, 0.01 - 1e-8};
    ball.velocity = {0.2, 0.0, 0.0};
    Wall floor;
    floor.name = "floor";
    floor.shape = Plane{.point = {}, .normal = {0.0, 0.0, 1.0}};
    scene.walls.push_back(floor);
    scene.gravity = Vec3{0.0, 0.0, -9.81};
    scene.contact.stiffness = ConstantStiffness::Params{.normal = 1e6, .shear = 1e6};
    scene.contact.friction = CoulombFriction::Params{.coefficient = 0.5};
    scene.contact.damping = ViscousDamping::Params{.normal = 0.5, .shear = 0.0};
    Simulation simulation(scene, 0);
    Observer nobody;
    simulation.advance(1U << 30U, nobody);
    const ParticleFrame frame = simulation.particle_frame();
    const double turned = 2.0 * std::atan2(frame.orientation.at(0)[2], frame.orientation[0][0]);
    EXPECT_NEAR(turned, frame.position[0].x / 0.01, 1e-3);
}

TEST(Orientation, GoesOnAfterARestart) {
    Scene scene = thrown_bed();
    scene.output.orientation = true;
    Observer nobody;
    Simulation straight(scene, 0);
    straight.advance(1200, nobody);
    Simulation first(scene, 0);
    first.advance(700, nobody);
    Archive archive;
    first.save(archive);
    Simulation second(scene, 0);
    second.load(archive);
    second.advance(500, nobody);
    EXPECT_EQ(second.particle_frame().orientation, straight.particle_frame().orientation);
    EXPECT_EQ(second.state_hash(), straight.state_hash());
}

TEST(Orientation, IsNotThereUnlessTheOutputAsks) {
    Scene scene = spinning_ball({1.0, 0.0, 0.0});
    scene.output.orientation = false;
    EXPECT_TRUE(Simulation(scene, 0).particle_frame().orientation.empty());
    scene.stages[0].output.emplace().orientation = true;
    EXPECT_EQ(Simulation(scene, 0).particle_frame().orientation.size(), 1U);
}

}  // namespace
}  // namespace grainbench::test
