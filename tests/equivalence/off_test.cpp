/// An effect of strength zero takes the path of a scene without it, bit for bit, and a scene
/// without it keeps no history for it.
#include "core/contact/contact_table.hpp"
#include "core/simulation.hpp"

#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace grainbench::test {
namespace {

using Change = std::function<void(Contact&)>;

Contact rough_spheres() {
    Contact contact = full_contact(1e4, 0.02);
    contact.normal = LinearSpring::Params{};
    return contact;
}

Contact hertz_spheres() {
    Contact contact;
    contact.stiffness = HertzStiffness::Params{.young_modulus = 1e7, .poisson_ratio = 0.3};
    contact.normal = HertzSpring::Params{};
    return contact;
}

void expect_same_path(const Contact& without, const Change& add_nothing) {
    Scene plain = gas_in_box(3);
    plain.contact = without;
    plain.timestep = AutomaticTimestep{};  // effects of strength zero must not shorten it either
    Scene with = plain;
    add_nothing(with.contact);
    Observer nobody;
    Simulation a(plain, 0);
    Simulation b(with, 0);
    std::size_t touches = 0;
    for (int step = 0; step < 1000; ++step) {
        a.advance(1, nobody);
        b.advance(1, nobody);
        ASSERT_EQ(a.particle_frame().position, b.particle_frame().position) << "step " << step;
        ASSERT_EQ(a.particle_frame().velocity, b.particle_frame().velocity) << "step " << step;
        ASSERT_EQ(a.particle_frame().angular_velocity, b.particle_frame().angular_velocity)
            << "step " << step;
        touches += a.touching_count();
    }
    EXPECT_GT(touches, 1000U);
}

TEST(EffectOfStrengthZero, IsAsGoodAsOffForRolling) {
    expect_same_path(rough_spheres(),
                     [](Contact& c) { c.rolling = RollingResistance::Params{0.0}; });
}

TEST(EffectOfStrengthZero, IsAsGoodAsOffForTwisting) {
    expect_same_path(rough_spheres(),
                     [](Contact& c) { c.twisting = TwistingResistance::Params{0.0}; });
}

TEST(EffectOfStrengthZero, IsAsGoodAsOffForCohesion) {
    expect_same_path(rough_spheres(), [](Contact& c) {
        c.cohesion = LinearCohesion::Params{0.0, 1e-5};
    });
}

TEST(EffectOfStrengthZero, IsAsGoodAsOffForMindlinFriction) {
    expect_same_path(hertz_spheres(),
                     [](Contact& c) { c.friction = MindlinFriction::Params{0.0}; });
}

TEST(EffectOfStrengthZero, IsAsGoodAsOffForDashpots) {
    expect_same_path(hertz_spheres(),
                     [](Contact& c) { c.damping = RestitutionDamping::Params{1.0}; });
    Contact bare = rough_spheres();
    bare.damping.reset();
    expect_same_path(bare, [](Contact& c) { c.damping = ViscousDamping::Params{}; });
}

TEST(EffectOfStrengthZero, IsAsGoodAsOffForCoulombFriction) {
    Contact bare = rough_spheres();
    bare.friction.reset();
    bare.damping.reset();
    expect_same_path(bare, [](Contact& c) { c.friction = CoulombFriction::Params{0.0}; });
}

TEST(EffectOfStrengthZero, IsAsGoodAsOffForASpringThatDoesNotYield) {
    Contact bare = rough_spheres();
    bare.friction.reset();
    bare.damping.reset();
    expect_same_path(bare, [](Contact& c) { c.normal = WaltonBraunSpring::Params{1.0}; });
}

int history_of(const Contact& contact) {
    Scene scene = gas_in_box(1);
    return ContactTable(contact, Materials(scene)).history_size();
}

TEST(EffectThatIsOff, RemembersNothing) {
    Contact contact = hertz_spheres();
    EXPECT_EQ(history_of(contact), 0);
    contact.damping = RestitutionDamping::Params{0.5};
    EXPECT_EQ(history_of(contact), 0);
    contact.friction = MindlinFriction::Params{0.5};
    EXPECT_EQ(history_of(contact), 4);
    contact.rolling = RollingResistance::Params{0.1};
    EXPECT_EQ(history_of(contact), 7);
    contact.twisting = TwistingResistance::Params{0.1};
    EXPECT_EQ(history_of(contact), 8);
    contact.normal = JkrAdhesion::Params{0.1};
    EXPECT_EQ(history_of(contact), 9);
}

}  // namespace
}  // namespace grainbench::test
