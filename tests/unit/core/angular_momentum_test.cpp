#include "core/simulation.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace grainbench {
namespace {

/// A small and a large sphere that meet off-centre, spinning.
Scene oblique_impact() {
    Scene scene;
    scene.particles.species = {{"small", 0.003, 1500.0}, {"large", 0.008, 2500.0}};
    Placement small{.species = "small", .position = {0.0, 0.0, 0.0}};
    small.velocity = {1.0, 0.3, 0.0};
    small.angular_velocity = {20.0, -50.0, 100.0};
    Placement large{.species = "large", .position = {0.0108, 0.004, 0.001}};
    large.angular_velocity = {-30.0, 10.0, 40.0};
    scene.particles.insertion = {ListInsertion{.particles = {small, large}}};
    scene.contact.stiffness = ConstantStiffness::Params{.normal = 1e4, .shear = 1e4};
    scene.contact.normal = IncrementalSpring::Params{};
    scene.contact.friction = CoulombFriction::Params{.coefficient = 0.4};
    scene.contact.damping = ViscousDamping::Params{.normal = 0.1, .shear = 0.1};
    scene.timestep = FixedTimestep{1e-5};
    Stage stage;
    stage.duration = 0.005;
    scene.stages = {stage};
    return scene;
}

/// About the origin [kg m^2/s].
Vec3 angular_momentum(const Simulation& simulation) {
    const ParticleFrame frame = simulation.particle_frame();
    Vec3 sum{};
    for (std::size_t k = 0; k < frame.id.size(); ++k) {
        const double density = frame.species[k] == 0 ? 1500.0 : 2500.0;
        const double r = frame.radius[k];
        const double mass = density * 4.0 / 3.0 * pi * r * r * r;
        sum += cross(frame.position[k], mass * frame.velocity[k]) +
               (0.4 * mass * r * r) * frame.angular_velocity[k];
    }
    return sum;
}

TEST(AngularMomentum, IsKeptByAContactOfUnequalSpheres) {
    Simulation simulation(oblique_impact(), 0);
    Observer nobody;
    simulation.advance(0, nobody);
    const Vec3 before = angular_momentum(simulation);
    const Vec3 spin_before = simulation.particle_frame().angular_velocity[1];
    while (!simulation.advance(1, nobody)) {
    }
    ASSERT_EQ(simulation.touching_count(), 0U);
    ASSERT_GT(norm(simulation.particle_frame().angular_velocity[1] - spin_before), 1.0);
    // Some ten roundings in each of 500 steps, of terms as large as the sum.
    const double round_off = 5000.0 * std::numeric_limits<double>::epsilon() * norm(before);
    EXPECT_LE(norm(angular_momentum(simulation) - before), round_off);
}

/// Spin that a sphere gains in the impact, times its moment of inertia [kg m^2/s].
struct Gains {
    Vec3 small, large;
};

Gains gains_of(Scene scene) {
    Simulation simulation(std::move(scene), 0);
    Observer nobody;
    simulation.advance(0, nobody);
    const ParticleFrame before = simulation.particle_frame();
    while (!simulation.advance(1, nobody)) {
    }
    const ParticleFrame after = simulation.particle_frame();
    const auto gain = [&](std::size_t k, double density) {
        const double r = after.radius[k];
        const double mass = density * 4.0 / 3.0 * pi * r * r * r;
        return (0.4 * mass * r * r) * (after.angular_velocity[k] - before.angular_velocity[k]);
    };
    return {gain(0, 1500.0), gain(1, 2500.0)};
}

TEST(LeverArm, OfTheRadiusTurnsEachSphereInProportionToItsOwn) {
    Scene scene = oblique_impact();
    scene.contact.lever_arm = LeverArm::radius;
    const Gains rigid = gains_of(scene);
    ASSERT_GT(norm(rigid.small), 0.0);
    // One impact over 500 steps of at most ten roundings.
    const double round_off = 5000.0 * std::numeric_limits<double>::epsilon() * norm(rigid.large);
    EXPECT_LE(norm(rigid.large - 8.0 / 3.0 * rigid.small), round_off);
    // The contact point is nearer to both by half an overlap, some 50 um here.
    const Gains soft = gains_of(oblique_impact());
    EXPECT_GT(norm(soft.large - 8.0 / 3.0 * soft.small), 1e-3 * norm(rigid.large));
}

}  // namespace
}  // namespace grainbench
