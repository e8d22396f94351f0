#include "core/statistics/verdict.hpp"

#include "tests/unit/statistics/draws.hpp"

#include <gtest/gtest.h>

namespace grainbench::statistics {
namespace {

constexpr double margin = 1.0;

/// How often each verdict is given for two samples whose means differ by `difference`.
struct Frequencies {
    double same = 0.0;
    double different = 0.0;
    double undecided = 0.0;
};

Frequencies verdicts_at(double difference,
                        std::size_t realisations,
                        double deviation,
                        std::uint64_t seed) {
    constexpr int draws = 10'000;
    Draws random(seed);
    Frequencies counted;
    for (int k = 0; k < draws; ++k) {
        const Sample a = sample_of(random.sample(realisations, difference, deviation));
        const Sample b = sample_of(random.sample(realisations, 0.0, deviation));
        switch (verdict_of(difference_of(a, b), margin)) {
            case Verdict::same:
                counted.same += 1.0 / draws;
                break;
            case Verdict::different:
                counted.different += 1.0 / draws;
                break;
            case Verdict::undecided:
                counted.undecided += 1.0 / draws;
                break;
        }
    }
    return counted;
}

/// Five standard errors of a frequency of 0.05 over 10 000 draws.
constexpr double chance = 0.011;

TEST(Verdict, OfADifferenceAtTheMarginIsWrongNoMoreOftenThanPromised) {
    // At the margin both `same` and `different` are wrong to say; beyond it only the first, and
    // within it only the second, and less often.
    for (const std::size_t n : {3U, 6U, 12U}) {
        for (const double deviation : {0.1, 0.5}) {
            const Frequencies at = verdicts_at(margin, n, deviation, n);
            EXPECT_LE(at.same, verdict_alpha + chance) << n << " " << deviation;
            EXPECT_LE(at.different, 0.5 * verdict_alpha + chance) << n << " " << deviation;
            const Frequencies beyond = verdicts_at(1.2 * margin, n, deviation, n);
            EXPECT_LE(beyond.same, verdict_alpha + chance) << n << " " << deviation;
            const Frequencies within = verdicts_at(0.8 * margin, n, deviation, n);
            EXPECT_LE(within.different, 0.5 * verdict_alpha + chance) << n << " " << deviation;
        }
    }
}

TEST(Verdict, ErrorsReachThePromisedRateWhereTheSpreadIsSmall) {
    // So that the test above is not passed by never deciding: with many realisations and a small
    // spread both errors at the margin come as often as their levels say.
    const Frequencies at = verdicts_at(margin, 24, 0.2, 5);
    EXPECT_NEAR(at.same, verdict_alpha, chance);
    EXPECT_NEAR(at.different, 0.5 * verdict_alpha, chance);
}

TEST(Verdict, IsUndecidedWithoutAStandardError) {
    EXPECT_EQ(verdict_of(Estimate{.value = 0.0}, margin), Verdict::undecided);
    EXPECT_EQ(verdict_of(Estimate{.value = 100.0}, margin), Verdict::undecided);
}

TEST(Verdict, OfEqualNumbersIsKnownWithoutSpread) {
    EXPECT_EQ(verdict_of({.value = 0.0, .standard_error = 0.0, .degrees_of_freedom = 4.0}, margin),
              Verdict::same);
    EXPECT_EQ(verdict_of({.value = -1.5, .standard_error = 0.0, .degrees_of_freedom = 4.0}, margin),
              Verdict::different);
}

TEST(RealisationsToDecide, AreThoseThatDecideInFourOfFiveRepetitions) {
    struct Setting {
        double difference, deviation;
    };

    for (const Setting& s :
         {Setting{0.0, 0.6}, Setting{0.3, 0.4}, Setting{1.6, 0.5}, Setting{-2.0, 2.0}}) {
        const auto needed =
            realisations_to_decide(s.difference, s.deviation * std::sqrt(2.0), margin);
        ASSERT_TRUE(needed.has_value()) << s.difference;
        const Frequencies at = verdicts_at(s.difference, *needed, s.deviation, 3);
        const bool is_within = std::abs(s.difference) < margin;
        // Whole numbers overshoot, and where the difference is not zero one of the two tests of
        // `same` is all but sure to pass.
        EXPECT_GE(is_within ? at.same : at.different, 0.8 - chance) << s.difference;
        EXPECT_LE(is_within ? at.same : at.different, 0.95) << s.difference;
    }
}

TEST(RealisationsToDecide, FollowThePublishedFormula) {
    // Chow, Shao and Wang 3.2.4 with z for t: (1.6449 + 1.2816)^2 2 0.1^2 / 0.04^2 = 107.06 at
    // their power of 0.8; t instead of z adds about one.
    EXPECT_NEAR(
        static_cast<double>(realisations_to_decide(0.01, 0.1 * std::sqrt(2.0), 0.05).value()),
        108.0,
        1.0);
}

TEST(RealisationsToDecide, AreNoneForADifferenceAtTheMargin) {
    EXPECT_FALSE(realisations_to_decide(margin, 0.5, margin).has_value());
    EXPECT_FALSE(realisations_to_decide(0.999, 0.5, margin).has_value());
}

}  // namespace
}  // namespace grainbench::statistics
