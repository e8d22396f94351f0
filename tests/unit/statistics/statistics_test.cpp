#include "core/statistics/estimate.hpp"
#include "core/statistics/pareto.hpp"
#include "core/statistics/student.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace grainbench::statistics {
namespace {

TEST(Student, QuantilesAreThoseOfTheTables) {
    // Printed to three digits in any table of the distribution; 0.9303... is
    // 1/2 + (sqrt(3) t / (t^2 + 3) + atan(t / sqrt(3))) / pi at t = 2, the closed form for nu = 3.
    struct Row {
        double p, nu, t;
    };

    for (const Row& row : {Row{0.95, 1, 6.314},
                           Row{0.975, 2, 4.303},
                           Row{0.975, 4, 2.776},
                           Row{0.95, 10, 1.812},
                           Row{0.995, 30, 2.750},
                           Row{0.975, 120, 1.980}}) {
        EXPECT_NEAR(student_quantile(row.p, row.nu), row.t, 5e-4) << row.nu;
    }
    const double closed =
        0.5 + (std::sqrt(3.0) * 2.0 / 7.0 + std::atan(2.0 / std::sqrt(3.0))) / 3.14159265358979324;
    EXPECT_NEAR(student_cdf(2.0, 3.0), closed, 1e-12);
}

TEST(Student, QuantileUndoesTheDistributionForAnyDegreesOfFreedom) {
    for (const double nu : {0.5, 1.0, 1.7, 2.0, 3.3, 12.0, 500.0, 1e6}) {
        for (const double p : {1e-6, 0.01, 0.3, 0.5, 0.9, 0.975, 1.0 - 1e-6}) {
            // Logarithms of gamma functions of size nu log nu cancel: round-off grows with nu.
            EXPECT_NEAR(student_cdf(student_quantile(p, nu), nu), p, 1e-11 + 1e-15 * nu)
                << nu << " " << p;
        }
    }
}

TEST(Estimate, OfAMeanIsWorkedByHand) {
    // 2, 4, 9: mean 5, squares 9 + 1 + 16 = 26, deviation sqrt(13), error sqrt(13 / 3).
    const Estimate mean = mean_of(sample_of(std::array{2.0, 4.0, 9.0}));
    EXPECT_DOUBLE_EQ(mean.value, 5.0);
    EXPECT_DOUBLE_EQ(mean.standard_error, std::sqrt(13.0 / 3.0));
    EXPECT_DOUBLE_EQ(mean.degrees_of_freedom, 2.0);
    const Interval interval = interval_of(mean, 0.95);
    EXPECT_NEAR(interval.high - 5.0, 4.302653 * std::sqrt(13.0 / 3.0), 1e-6);
    EXPECT_NEAR(5.0 - interval.low, interval.high - 5.0, 1e-12);
}

TEST(Estimate, OfADifferenceHasWelchsDegreesOfFreedom) {
    // v_a = 13 / 3; b = 1, 2: deviation sqrt(1/2), v_b = 1/4.
    // nu = (13/3 + 1/4)^2 / ((13/3)^2 / 2 + (1/4)^2 / 1) = 21.00694 / 9.45139 = 2.22263...
    const Estimate difference =
        difference_of(sample_of(std::array{2.0, 4.0, 9.0}), sample_of(std::array{1.0, 2.0}));
    EXPECT_DOUBLE_EQ(difference.value, 3.5);
    EXPECT_DOUBLE_EQ(difference.standard_error, std::sqrt(13.0 / 3.0 + 0.25));
    const double v = 13.0 / 3.0;
    EXPECT_NEAR(
        difference.degrees_of_freedom, (v + 0.25) * (v + 0.25) / (v * v / 2.0 + 0.0625), 1e-12);
}

TEST(Estimate, OfPairsSeesOnlyTheirDifferences) {
    const Estimate paired =
        paired_difference_of(std::array{11.0, 22.0, 36.0}, std::array{10.0, 20.0, 33.0});
    EXPECT_DOUBLE_EQ(paired.value, 2.0);
    EXPECT_DOUBLE_EQ(paired.standard_error, 1.0 / std::sqrt(3.0));
    EXPECT_DOUBLE_EQ(paired.degrees_of_freedom, 2.0);
}

TEST(Estimate, OfOneValueHasNoEndOfItsInterval) {
    const Estimate alone = mean_of(sample_of(std::array{3.0}));
    EXPECT_DOUBLE_EQ(alone.value, 3.0);
    EXPECT_TRUE(std::isinf(interval_of(alone, 0.95).high));
    EXPECT_TRUE(std::isinf(
        difference_of(sample_of(std::array{3.0}), sample_of(std::array{1.0, 2.0})).standard_error));
}

TEST(Pareto, FrontHoldsWhatNothingBeats) {
    // 1 is beaten by 0 (same cost, larger error), 3 by 2 (more cost, same error).
    const std::array<CostAndError, 5> points{{{1, 9}, {1, 10}, {2, 5}, {3, 5}, {4, 1}}};
    EXPECT_EQ(pareto_front(points), (std::vector<std::size_t>{0, 2, 4}));
}

}  // namespace
}  // namespace grainbench::statistics
