// Intervals hold what they promise: the true value lies inside as often as the level says.
#include "core/statistics/curves.hpp"

#include "tests/unit/statistics/draws.hpp"

#include <gtest/gtest.h>

namespace grainbench::statistics {
namespace {

constexpr int draws = 10'000;
constexpr double nominal = 0.95;

/// One percent, as asked of them; five standard errors of a frequency over so many draws.
constexpr double one_percent = 0.01;

double coverage_of_difference(std::size_t n_a, std::size_t n_b, double deviation_a) {
    Draws random(n_a + 100 * n_b);
    return frequency(draws, [&] {
        const Sample a = sample_of(random.sample(n_a, 2.0, deviation_a));
        const Sample b = sample_of(random.sample(n_b, 1.5, 1.0));
        return interval_of(difference_of(a, b), nominal).contains(0.5);
    });
}

TEST(Coverage, OfAMeanIsNominalFromTwoRealisationsOn) {
    for (const std::size_t n : {2U, 3U, 6U, 24U}) {
        Draws random(n);
        const double covered = frequency(draws, [&] {
            return interval_of(mean_of(sample_of(random.sample(n, 7.0, 3.0))), nominal)
                .contains(7.0);
        });
        EXPECT_NEAR(covered, nominal, one_percent) << n;
    }
}

TEST(Coverage, OfWelchsDifferenceIsNominalFromSixRealisationsOn) {
    EXPECT_NEAR(coverage_of_difference(6, 6, 1.0), nominal, one_percent);
    EXPECT_NEAR(coverage_of_difference(6, 6, 3.0), nominal, one_percent);
    EXPECT_NEAR(coverage_of_difference(12, 12, 2.0), nominal, one_percent);
    EXPECT_NEAR(coverage_of_difference(12, 24, 3.0), nominal, one_percent);
    EXPECT_NEAR(coverage_of_difference(24, 24, 1.0), nominal, one_percent);
}

TEST(Coverage, OfWelchsDifferenceIsWithinTwoPercentForThreeRealisations) {
    // The degrees of freedom come from two variances with two each: too few of them for equal
    // spreads (0.966), hardly wrong for others.
    for (const double deviation : {1.0, 2.0, 4.0, 10.0}) {
        EXPECT_NEAR(coverage_of_difference(3, 3, deviation), nominal, 2.0 * one_percent)
            << deviation;
    }
}

TEST(Coverage, OfABandOverAWholeCurveIsAtLeastNominalForFewRealisations) {
    EXPECT_GE(coverage_of_band(3, 0.9, 1000), nominal);
    EXPECT_GE(coverage_of_band(6, 0.0, 1000), nominal);
}

}  // namespace
}  // namespace grainbench::statistics
