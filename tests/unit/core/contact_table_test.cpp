#include "core/contact/contact_table.hpp"

#include <gtest/gtest.h>

namespace grainbench {
namespace {

Scene scene_with(const NormalLaw& normal) {
    Scene scene;
    scene.particles.species = {{"ball", 0.003, 1500.0}};
    scene.contact.stiffness = ConstantStiffness::Params{.normal = 1e4, .shear = 1e4};
    scene.contact.normal = normal;
    scene.contact.friction = CoulombFriction::Params{.coefficient = 0.5};
    return scene;
}

/// The incremental spring keeps one number in front of the three of friction.
TEST(ContactTable, FrictionKeepsItsHistoryWhereTheSpringChanges) {
    const Scene with = scene_with(IncrementalSpring::Params{});
    const Scene without = scene_with(LinearSpring::Params{});
    const ContactTable incremental(with.contact, Materials(with));
    const ContactTable absolute(without.contact, Materials(without));
    EXPECT_EQ(history_sources(incremental, absolute), (std::vector<int>{1, 2, 3}));
    EXPECT_EQ(history_sources(absolute, incremental), (std::vector<int>{-1, 0, 1, 2}));
    EXPECT_EQ(history_sources(incremental, incremental), (std::vector<int>{0, 1, 2, 3}));
}

}  // namespace
}  // namespace grainbench
