/// What a contact with one face of a wall remembers when the particle meets another face.
#include "core/simulation.hpp"

#include <gtest/gtest.h>

#include <string>

namespace grainbench {
namespace {

constexpr double radius = 0.003;
constexpr double density = 1500.0;
constexpr double gravity = 9.8;
constexpr double weight = density * 4.0 / 3.0 * pi * radius * radius * radius * gravity;

/// A frictionless sphere that lies on the face that `down` points to and slides along `way` until
/// it meets the next face. The incremental spring makes the force a matter of memory alone.
Scene sliding_sphere(const WallShape& shape, const Vec3& down, const Vec3& way) {
    Scene scene;
    scene.gravity = gravity * down;
    scene.particles.species = {{"ball", radius, density}};
    scene.particles.insertion = {
        ListInsertion{.particles = {{.species = "ball",
                                     .position = (0.02 - radius) * down + 0.015 * way,
                                     .velocity = 0.05 * way}}}};
    scene.walls = {{.name = "wall", .shape = shape, .motion = FixedMotion{}, .material = {}}};
    scene.contact.stiffness = ConstantStiffness::Params{.normal = 1000.0, .shear = 0.0};
    scene.contact.normal = IncrementalSpring::Params{};
    scene.contact.damping = ViscousDamping::Params{.normal = 0.5};
    scene.timestep = FixedTimestep{2e-5};
    Stage stage;
    stage.duration = 0.08;
    scene.stages = {stage};
    scene.output.contacts = true;
    scene.output.frame_interval = 1e-5;  // contacts are looked at in every cycle
    return scene;
}

/// Runs it; once it lies still on its face, that face must bear its weight in every step.
void expect_face_bears_weight(const Scene& scene, const Vec3& down) {
    Simulation simulation(scene, 0);
    Observer nobody;
    int steps_on_both = 0;
    while (!simulation.advance(1, nobody)) {
        if (simulation.time() < 0.02) {
            continue;
        }
        const ContactFrame frame = simulation.contact_frame();
        double force = 0.0;
        for (std::size_t c = 0; c < frame.overlap.size(); ++c) {
            const Vec3 normal = normalized(frame.j_position[c] - frame.i_position[c]);
            force += frame.force_normal[c] * dot(normal, down);
        }
        steps_on_both += frame.overlap.size() >= 2 ? 1 : 0;
        // The damped swing after the release has died away to this in 0.02 s.
        ASSERT_NEAR(force, weight, 1e-3 * weight) << "time " << simulation.time();
    }
    EXPECT_GT(steps_on_both, 5);
}

TEST(WallContacts, KeepTheForceOfOneFaceOfABoxWhenAnotherIsMet) {
    const BoxShape box{{-0.02, -0.02, -0.02}, {0.02, 0.02, 0.02}};
    const Vec3 directions[] = {{1.0, 0.0, 0.0},
                               {-1.0, 0.0, 0.0},
                               {0.0, 1.0, 0.0},
                               {0.0, -1.0, 0.0},
                               {0.0, 0.0, 1.0},
                               {0.0, 0.0, -1.0}};
    for (const Vec3& down : directions) {
        for (const Vec3& way : directions) {
            if (dot(down, way) == 0.0) {
                SCOPED_TRACE("on face " + std::to_string(&down - directions) + " towards " +
                             std::to_string(&way - directions));
                expect_face_bears_weight(sliding_sphere(box, down, way), down);
            }
        }
    }
}

TEST(WallContacts, KeepTheForceOfTheFloorOfACylinderWhenItsSideIsMet) {
    const Vec3 base{0.0, 0.0, -0.02};
    const Vec3 down{0.0, 0.0, -1.0};
    const WallShape shapes[] = {
        Cylinder{.base = base, .radius = 0.02, .height = 0.04},
        FacetedCylinder{.base = base, .radius = 0.02, .height = 0.04, .resolution = 0.1}};
    for (const WallShape& shape : shapes) {
        for (const double turn : {0.1, 1.3, 2.9, 4.4}) {
            SCOPED_TRACE("shape " + std::to_string(shape.index()) + ", direction " +
                         std::to_string(turn));
            const Vec3 way{std::cos(turn), std::sin(turn), 0.0};
            expect_face_bears_weight(sliding_sphere(shape, down, way), down);
        }
    }
}

}  // namespace
}  // namespace grainbench
