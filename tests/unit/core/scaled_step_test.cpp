/// What remains of a stage with scaled inertia: positions and forces, not masses.
#include "core/simulation.hpp"

#include <gtest/gtest.h>

namespace grainbench {
namespace {

constexpr double radius = 0.003;
constexpr double density = 1500.0;
constexpr double stiffness = 1000.0;
constexpr double gravity = 9.8;
constexpr double weight = density * 4.0 / 3.0 * pi * radius * radius * radius * gravity;

/// A sphere that comes to rest on a plane while its inertia is scaled, and then goes on unscaled
/// and undamped.
Scene resting_sphere() {
    Scene scene;
    scene.gravity = Vec3{0.0, 0.0, -gravity};
    scene.particles.species = {{"ball", radius, density}};
    scene.particles.insertion = {
        ListInsertion{.particles = {{.species = "ball", .position = {0.0, 0.0, radius - 1e-7}}}}};
    scene.walls = {{.name = "floor", .shape = Plane{}, .motion = FixedMotion{}, .material = {}}};
    scene.contact.stiffness = ConstantStiffness::Params{.normal = stiffness, .shear = 0.0};
    scene.contact.normal = LinearSpring::Params{};
    scene.contact.damping = ViscousDamping::Params{.normal = 0.7};
    scene.timestep = ScaledTimestep{.value = 1e-3};
    Stage settle;
    settle.duration = 0.2;
    Stage go_on;
    go_on.duration = 0.05;
    go_on.timestep = AutomaticTimestep{};
    go_on.contact = scene.contact;
    go_on.contact->damping.reset();
    scene.stages = {settle, go_on};
    return scene;
}

TEST(ScaledTimestep, LeavesARestingSphereAtRestWhenInertiaIsRealAgain) {
    Simulation simulation(resting_sphere(), 0);
    Observer nobody;
    double lowest = radius;
    double highest = 0.0;
    while (!simulation.advance(1, nobody)) {
        if (simulation.stage() == 1) {
            const double height = simulation.particle_frame().position[0].z;
            lowest = std::min(lowest, height);
            highest = std::max(highest, height);
        }
    }
    // 200 steps at a damping ratio of 0.7 leave nothing of the first indentation that the tolerance
    // could see. With masses still scaled, or a kick by twice the weight, it would swing by far
    // more.
    const double expected = radius - weight / stiffness;
    const double tolerance = 1e-5 * weight / stiffness;
    EXPECT_NEAR(lowest, expected, tolerance);
    EXPECT_NEAR(highest, expected, tolerance);
}

}  // namespace
}  // namespace grainbench
