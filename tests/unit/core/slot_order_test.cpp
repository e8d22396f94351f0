/// Sorting slots anew changes nothing but the order of sums.
#include "core/engine.hpp"

#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

#include <set>
#include <utility>

namespace grainbench::test {
namespace {

Contact elastic_spheres() {
    Contact contact;
    contact.stiffness = HertzStiffness::Params{.young_modulus = 1e7, .poisson_ratio = 0.3};
    contact.normal = HertzSpring::Params{};
    contact.friction = MindlinFriction::Params{0.5};
    contact.damping = RestitutionDamping::Params{0.5, true};
    contact.rolling = RollingResistance::Params{0.1, 0.7};
    contact.twisting = TwistingResistance::Params{0.1, 0.7};
    return contact;
}

Contact sticky_spheres() {
    Contact contact = elastic_spheres();
    contact.normal = JkrAdhesion::Params{0.1};
    return contact;
}

Contact yielding_spheres() {
    Contact contact = full_contact(1e4, 0.2);
    contact.normal = WaltonBraunSpring::Params{0.6};
    return contact;
}

/// A bed under motion, its slots no longer in order. All that stays from step to step is there:
/// friction, moments, springs that remember, a ledger.
Scene tumbled_bed(const Contact& contact) {
    Scene scene = thrown_bed();
    scene.stages.resize(1);
    scene.stages[0].duration = 1.0;
    scene.stages[0].motions = {
        {"container", RotationMotion{.point = {}, .axis = {1.0, 0.2, 0.0}, .rate = 30.0}}};
    scene.contact = contact;
    scene.timestep = FixedTimestep{5e-6};
    return scene;
}

void run(Engine& engine, int cycles) {
    for (int n = 0; n < cycles; ++n) {
        engine.step();
    }
}

/// Touching pairs by the ids of i and j.
std::set<std::pair<std::int64_t, std::int64_t>> touching_ids(const Engine& engine) {
    std::set<std::pair<std::int64_t, std::int64_t>> ids;
    for (const TouchingContact contact : engine.pairs().touching()) {
        ids.insert({engine.particles().id(engine.pairs().objects().i[contact.place()]),
                    engine.particles().id(engine.pairs().objects().j[contact.place()])});
    }
    return ids;
}

class SlotOrder : public ::testing::TestWithParam<Contact> {};

TEST_P(SlotOrder, SortingLeavesTheMotionAsItIs) {
    const Scene scene = tumbled_bed(GetParam());
    Engine sorted(scene, 10001, {});
    sorted.begin_stage(scene.stages[0]);
    run(sorted, 6000);
    Archive archive;
    sorted.save(archive);
    Engine unsorted(scene, 10001, {});
    unsorted.begin_stage(scene.stages[0]);
    unsorted.load(archive);

    const auto before = touching_ids(sorted);
    sorted.sort_slots();
    std::size_t turned = 0;
    for (const auto& [i, j] : touching_ids(sorted)) {
        turned += before.contains({i, j}) ? 0 : 1;
        EXPECT_TRUE(before.contains({i, j}) || before.contains({j, i}));
    }
    EXPECT_EQ(touching_ids(sorted).size(), before.size());
    EXPECT_GT(turned, 3U);

    run(sorted, 100);
    run(unsorted, 100);
    for (std::size_t n = 0; n < sorted.particles().size(); ++n) {
        const Index a = sorted.particles().slots_by_id()[n];
        const Index b = unsorted.particles().slots_by_id()[n];
        // Round-off of forces of 0.1 N on 1e-5 kg in 100 steps, after some impacts.
        EXPECT_LT(norm(sorted.particles().velocity(a) - unsorted.particles().velocity(b)), 1e-10);
        EXPECT_LT(norm(sorted.particles().spin(a) - unsorted.particles().spin(b)), 1e-7);
    }
    EXPECT_NEAR(sorted.energies().numerical, unsorted.energies().numerical, 1e-12);
    EXPECT_NEAR(
        sorted.energies().dissipated_dashpot, unsorted.energies().dissipated_dashpot, 1e-12);
    EXPECT_EQ(sorted.pairs().late_count(), unsorted.pairs().late_count());
}

INSTANTIATE_TEST_SUITE_P(Laws,
                         SlotOrder,
                         ::testing::Values(full_contact(1e4, 0.2),
                                           elastic_spheres(),
                                           sticky_spheres(),
                                           yielding_spheres()));

}  // namespace
}  // namespace grainbench::test
