/// The engine against its own reference: one lane, and every pair and every patch looked at in
/// every step.
#include "core/simulation.hpp"

#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

namespace grainbench::test {
namespace {

constexpr int step_count = 1000;

/// Exact: lists leave pairs out but keep their order, so both engines add the same forces in the
/// same order, and every instruction set rounds alike. A tolerance would only hide a missed
/// contact. The one thing that may differ is a contact found after it began, which the lists treat
/// as a whole step of contact; the seeds have none.
void expect_same_path(const Scene& scene) {
    Observer nobody;
    Simulation fast(scene, 0);
    Simulation reference(scene, 0, {.isa = "", .reference = true});
    std::size_t touches = 0;
    for (int step = 0; step < step_count; ++step) {
        fast.advance(1, nobody);
        reference.advance(1, nobody);
        const ParticleFrame a = fast.particle_frame();
        const ParticleFrame b = reference.particle_frame();
        ASSERT_EQ(fast.touching_count(), reference.touching_count()) << "step " << step;
        ASSERT_EQ(a.contacts, b.contacts) << "step " << step;
        ASSERT_EQ(a.position, b.position) << "step " << step;
        ASSERT_EQ(a.velocity, b.velocity) << "step " << step;
        ASSERT_EQ(a.angular_velocity, b.angular_velocity) << "step " << step;
        touches += fast.touching_count();
    }
    EXPECT_EQ(fast.summary().late_contacts, 0U);
    EXPECT_GT(touches, 1000U);
    EXPECT_GT(fast.summary().candidate_builds, 1U);
    EXPECT_LT(fast.candidate_count(), reference.candidate_count() / 2);
}

class Reference : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(Reference, TakesTheSamePathAsTheLists) {
    expect_same_path(gas_in_box(GetParam()));
}

TEST_P(Reference, TakesTheSamePathAsAnAbsoluteSpring) {
    Scene scene = gas_in_box(GetParam());
    scene.contact.normal = LinearSpring::Params{};
    expect_same_path(scene);
}

TEST_P(Reference, TakesTheSamePathWhereParticlesComeAndGo) {
    expect_same_path(with_traffic(gas_in_box(GetParam())));
}

TEST_P(Reference, TakesTheSamePathAsASearchInEveryStep) {
    Scene scene = gas_in_box(GetParam());
    scene.detection.trigger = RemapInterval{1};
    expect_same_path(scene);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Reference, ::testing::Values(1, 2, 3, 4, 5));

}  // namespace
}  // namespace grainbench::test
