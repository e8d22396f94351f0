#include "core/measure/contact_scales.hpp"

#include "core/contact/contact_table.hpp"
#include "core/effects.hpp"
#include "core/integrate/stable_step.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace grainbench {
namespace {

using testing::Field;
using testing::IsEmpty;

/// Both balls of the example and its container, with all laws of the linear model.
Scene example() {
    Scene scene;
    scene.particles.species = {{.name = "small", .radius = 0.003, .density = 1500},
                               {.name = "large", .radius = 0.006, .density = 2500}};
    scene.walls.resize(1);
    scene.walls[0].name = "container";
    ConstantStiffness::Params stiffness;
    stiffness.normal = 1e7;
    stiffness.shear = 1e7;
    scene.contact.stiffness = stiffness;
    CoulombFriction::Params friction;
    friction.coefficient = 0.6;
    scene.contact.friction = friction;
    ViscousDamping::Params damping;
    damping.normal = 0.02;
    damping.shear = 0.02;
    scene.contact.damping = damping;
    scene.stages.resize(1);
    scene.stages[0].duration = 1.0;
    return scene;
}

ParticleFrame one_of_each() {
    ParticleFrame frame;
    frame.id = {1, 2};
    frame.species = {0, 1};
    frame.radius = {0.003, 0.006};
    return frame;
}

const ContactTime& time_of(const ContactScales& scales, const char* first, const char* second) {
    for (const ContactTime& time : scales.times) {
        if (time.first == first && time.second == second) {
            return time;
        }
    }
    throw std::out_of_range(first);
}

TEST(ContactScales, ContactTimesAreThoseOfTheHalfOscillation) {
    const Scene scene = example();
    const ContactScales scales = contact_scales(scene, scene.contact, one_of_each());
    // m_c from masses of 1.69646e-4 and 2.26195e-3 kg by hand; t_c = pi sqrt(m_c / 1e7). Half a
    // unit of the last digit.
    EXPECT_NEAR(time_of(scales, "small", "small").mass, 8.4823e-5, 5e-10);
    EXPECT_NEAR(time_of(scales, "small", "large").mass, 1.57810e-4, 5e-10);
    EXPECT_NEAR(time_of(scales, "small", "small").duration, 9.15e-6, 5e-9);
    EXPECT_NEAR(time_of(scales, "small", "container").duration, 1.29e-5, 5e-8);
    EXPECT_NEAR(time_of(scales, "large", "large").duration, 3.34e-5, 5e-8);
    EXPECT_EQ(scales.times.front().second, "small");
}

TEST(ContactScales, LimitIsThatOfTheAutomaticStep) {
    Scene scene = example();
    DeformabilityStiffness::Params deformable;
    deformable.modulus = 3e6;
    deformable.ratio = 2.0;
    for (const bool rotates : {true, false}) {
        if (!rotates) {
            deformable.ratio = 4.0;  // k_s R^2 / I = 2.5 k_s / m falls below k_n / m
            scene.contact.stiffness = deformable;
        }
        const ContactScales scales = contact_scales(scene, scene.contact, one_of_each());
        std::vector<Sphere> spheres(2);
        spheres[0].radius = 0.003;
        spheres[1].species = 1;
        spheres[1].radius = 0.006;
        const std::vector<double> densities{1500.0, 2500.0};
        const ParticleState state(spheres, densities);
        const Materials materials(scene);
        const double expected = StableStep::single_contact_limit(
            state, ContactTable(scene.contact, materials), materials.count());
        // Another order of the same few products: some roundings.
        EXPECT_NEAR(
            scales.limit.timestep, expected, 8 * std::numeric_limits<double>::epsilon() * expected);
        EXPECT_EQ(scales.limit.rotation_rules, rotates);
        EXPECT_EQ(scales.limit.species, "small");
    }
}

TEST(ContactScales, SpeciesWithoutParticlesDoNotCount) {
    const Scene scene = example();
    ParticleFrame large;
    large.id = {1};
    large.species = {1};
    large.radius = {0.006};
    EXPECT_EQ(contact_scales(scene, scene.contact, large).times.size(), 2U);
    EXPECT_THAT(contact_scales(scene, scene.contact, {}).times, IsEmpty());
}

TEST(ContactScales, PairsHaveTheirOwnStiffness) {
    Scene scene = example();
    ConstantStiffness::Params soft;
    soft.normal = 1e5;
    PairContact pair;
    pair.between = {"large", "small"};
    pair.stiffness = soft;
    scene.contact.pairs.push_back(pair);
    const ContactScales scales = contact_scales(scene, scene.contact, one_of_each());
    EXPECT_EQ(time_of(scales, "small", "large").stiffness, 1e5);
    EXPECT_EQ(time_of(scales, "small", "small").stiffness, 1e7);
}

TEST(ContactScales, ApproachIsSeenIfASphereStaysWithinItsTolerance) {
    // 0.0625 * 3 mm in 10 steps of 1e-5 s; the product and the quotient round once each.
    EXPECT_DOUBLE_EQ(surest_approach_speed({}, 0.003, 1e-5, 10), 1.875);
}

TEST(Effects, AreListedWithTheirPlace) {
    Scene scene = example();
    scene.stages[0].contact = scene.contact;
    scene.stages[0].contact->friction.reset();
    std::vector<std::string> found;
    for (const Effect& effect : effects_of(scene)) {
        found.push_back(effect.name + " " + effect.pointer);
    }
    EXPECT_THAT(found,
                testing::ElementsAre("constant_stiffness /contact/stiffness",
                                     "linear_spring /contact/normal",
                                     "coulomb_friction /contact/friction",
                                     "viscous_damping /contact/damping",
                                     "automatic_timestep /timestep",
                                     "displacement_trigger /detection/trigger",
                                     "constant_stiffness /stages/0/contact/stiffness",
                                     "linear_spring /stages/0/contact/normal",
                                     "viscous_damping /stages/0/contact/damping"));
}

TEST(Effects, AreIdleOnlyIfNoPairMakesThemAct) {
    Scene scene = example();
    EXPECT_THAT(idle_effects(scene), IsEmpty());
    std::get<CoulombFriction::Params>(*scene.contact.friction).coefficient = 0.0;
    EXPECT_THAT(idle_effects(scene),
                testing::ElementsAre(Field(&IdleEffect::pointer, "/contact/friction")));
    CoulombFriction::Params rough;
    rough.coefficient = 0.5;
    PairContact pair;
    pair.between = {"small", "small"};
    pair.friction = rough;
    scene.contact.pairs.push_back(pair);
    EXPECT_THAT(idle_effects(scene), IsEmpty());
}

TEST(Effects, FrictionWithoutShearStiffnessIsIdle) {
    Scene scene = example();
    std::get<ConstantStiffness::Params>(scene.contact.stiffness).shear = 0.0;
    EXPECT_THAT(idle_effects(scene),
                testing::ElementsAre(Field(&IdleEffect::pointer, "/contact/friction")));
}

TEST(Effects, ALeverWithoutAForceIsIdle) {
    Scene scene = example();
    scene.contact.lever_arm = LeverArm::radius;
    EXPECT_THAT(effects_of(scene),
                testing::Contains(Field(&Effect::pointer, "/contact/lever_arm")));
    EXPECT_THAT(idle_effects(scene), IsEmpty());
    scene.contact.friction.reset();
    scene.contact.damping.reset();
    EXPECT_THAT(idle_effects(scene),
                testing::ElementsAre(Field(&IdleEffect::pointer, "/contact/lever_arm")));
}

}  // namespace
}  // namespace grainbench
