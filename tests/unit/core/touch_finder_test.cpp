/// The test of pairs that leaves most of them out, against a test of all.
#include "core/contact/touch_finder.hpp"

#include "core/contact/bits.hpp"

#include "tests/unit/core/search_support.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace grainbench {
namespace {

/// Particles wander for a while at one speed and then at another, a thousand times slower. Of 11
/// 175 pairs some 200 touch, and at the low speed few of them may open or close within many steps.
TEST(TouchFinder, AnswersAsATestOfAllPairs) {
    constexpr int steps = 2000;
    constexpr double fast = 2e-5;  // [m] a step
    constexpr double slow = 2e-8;
    std::mt19937_64 random(3);
    ParticleState particles = state_of(random_cloud(150, 2.0, 0.008, 3));
    PairList list;
    for (Index i = 0; i < particles.size(); ++i) {
        for (Index j = i + 1; j < particles.size(); ++j) {
            list.append(i, j);
        }
    }
    list.pad();
    const Kernels& kernels = kernels_for("");
    TouchFinder touch;
    touch.forget(list);
    std::vector<std::uint64_t> expected;
    std::vector<std::uint64_t> before(list.words());
    int unchanged = 0;
    int changed_when_slow = 0;
    std::size_t doubtful_when_slow = 0;
    for (int step = 0; step < steps; ++step) {
        SCOPED_TRACE("step " + std::to_string(step));
        const bool is_slow = step / 200 % 2 == 1;
        const double way = is_slow ? slow : fast;
        for (Index slot = 0; slot < particles.size(); ++slot) {
            shift(particles, slot, in_cube(random, way / std::sqrt(3.0)));
        }
        touch.add_travel(way);
        const double reach = step < 1000 ? 0.0 : 0.0002;
        const bool may_have_changed = touch.test(particles, list, reach, kernels, {});
        test_pairs(particles, list, reach, expected, kernels, {});
        ASSERT_TRUE(std::ranges::equal(touch.bits(), expected));
        const bool has_changed = expected != before;
        ASSERT_TRUE(may_have_changed || !has_changed);
        unchanged += may_have_changed ? 0 : 1;
        changed_when_slow += is_slow && has_changed ? 1 : 0;
        doubtful_when_slow += is_slow ? touch.doubtful().list().count : 0;
        before = expected;
    }
    EXPECT_GT(unchanged, steps / 4);
    EXPECT_GT(changed_when_slow, 3);
    EXPECT_LT(doubtful_when_slow, std::size_t{steps / 2} * list.count / 100);
}

/// A look-ahead leaves a list that is far too wide once the particles slow down, and all pairs are
/// tested meanwhile. What it says is old when they speed up again.
TEST(TouchFinder, DoesNotGoBackToAListThatItHasPassedOver) {
    constexpr double fast = 2e-5;  // [m] a step
    constexpr double slow = 1e-6;
    constexpr double near = 5.0 * fast;
    const Kernels& kernels = kernels_for("");
    int passed_over = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        std::mt19937_64 random(seed);
        ParticleState particles = state_of(random_cloud(300, 2.0, 0.008, seed));
        PairList list;  // of pairs that pays to doubt least: all may soon open or close
        const auto deep = brute_force_pairs(particles, 1.0, -near);
        for (const auto& pair : brute_force_pairs(particles, 1.0, near)) {
            if (!std::ranges::binary_search(deep, pair)) {
                list.append(pair.first, pair.second);
            }
        }
        list.pad();
        TouchFinder touch;
        touch.forget(list);
        std::vector<std::uint64_t> expected;
        for (int step = 0; step < 30; ++step) {
            SCOPED_TRACE("step " + std::to_string(step));
            const bool is_slow = 8 <= step && step < 25;
            const double way = is_slow ? slow : fast;
            for (Index slot = 0; slot < particles.size(); ++slot) {
                shift(particles, slot, way * normalized(in_cube(random, 1.0)));
            }
            touch.add_travel(way);
            if (step == 5) {
                touch.test_and_doubt(particles, list, 0.0, 20.0 * fast, kernels, {});
            } else {
                touch.test(particles, list, 0.0, kernels, {});
            }
            const std::vector<std::uint64_t> before = expected;
            test_pairs(particles, list, 0.0, expected, kernels, {});
            ASSERT_TRUE(std::ranges::equal(touch.bits(), expected));
            passed_over += is_slow && expected != before ? 1 : 0;
        }
    }
    EXPECT_GT(passed_over, 20);
}

}  // namespace
}  // namespace grainbench
