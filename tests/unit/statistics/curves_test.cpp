#include "core/statistics/curves.hpp"

#include "tests/unit/statistics/draws.hpp"

#include <gtest/gtest.h>

namespace grainbench::statistics {
namespace {

constexpr std::size_t points = 20;

/// Curves with a spread of `deviation`, raised by `step` from the middle on.
Curves raised(Curves curves, double deviation, double step) {
    for (std::vector<double>& curve : curves) {
        for (std::size_t k = 0; k < curve.size(); ++k) {
            curve[k] = deviation * curve[k] + (k >= curve.size() / 2 ? step : 0.0);
        }
    }
    return curves;
}

struct Frequencies {
    double same = 0.0;
    double different = 0.0;
};

Frequencies verdicts_at(double step, std::size_t realisations, double deviation, int times) {
    Draws random(7 + realisations);
    Frequencies counted;
    for (int k = 0; k < times; ++k) {
        const Curves a = raised(random.curves(realisations, points, 0.9), deviation, step);
        const Curves b = raised(random.curves(realisations, points, 0.9), deviation, 0.0);
        const Verdict verdict =
            verdict_of(curve_difference(
                           a, b, false, {.replicates = 199, .seed = static_cast<std::uint64_t>(k)}),
                       1.0);
        counted.same += verdict == Verdict::same ? 1.0 / times : 0.0;
        counted.different += verdict == Verdict::different ? 1.0 / times : 0.0;
    }
    return counted;
}

TEST(CurveVerdict, AtTheMarginIsWrongNoMoreOftenThanPromised) {
    // Five standard errors of a frequency of 0.05 are 0.024 over 2000 draws and 0.054 over 400.
    const Frequencies by_sidak = verdicts_at(1.0, 3, 0.1, 2000);
    EXPECT_LE(by_sidak.same, 0.05 + 0.024);
    EXPECT_LE(by_sidak.different, 0.05 + 0.024);
    const Frequencies by_bootstrap = verdicts_at(1.0, fewest_for_bootstrap, 0.1, 400);
    EXPECT_LE(by_bootstrap.same, 0.05 + 0.054);
    EXPECT_LE(by_bootstrap.different, 0.05 + 0.054);
}

TEST(CurveVerdict, SeesWhatIsPlain) {
    EXPECT_GE(verdicts_at(0.0, 6, 0.1, 200).same, 0.99);
    EXPECT_GE(verdicts_at(2.0, 6, 0.1, 200).different, 0.99);
    EXPECT_GE(verdicts_at(2.0, 3, 0.1, 200).different, 0.8);
}

TEST(CurveVerdict, OfOneRealisationIsUndecided) {
    const Curves one{{0.0, 1.0, 2.0}};
    const CurveDifference difference = curve_difference(one, {{0.0, 1.0, 5.0}}, false);
    EXPECT_EQ(difference.largest, 2U);
    EXPECT_DOUBLE_EQ(difference.at[2].value, -3.0);
    EXPECT_EQ(verdict_of(difference, 10.0), Verdict::undecided);
    EXPECT_FALSE(realisations_to_decide(difference, 1, 10.0).has_value());
}

TEST(CurveVerdict, NeedsAsManyRealisationsAsItsHardestPoint) {
    Draws random(3);
    const Curves a = raised(random.curves(6, points, 0.9), 0.5, 0.2);
    const Curves b = raised(random.curves(6, points, 0.9), 0.5, 0.0);
    const CurveDifference difference = curve_difference(a, b, false);
    ASSERT_EQ(verdict_of(difference, 0.9), Verdict::undecided);
    std::size_t most = 0;
    for (const Estimate& at : difference.at) {
        ASSERT_LT(std::abs(at.value), 0.9);
        const double spread = at.standard_error * std::sqrt(6.0);
        most = std::max(most, realisations_to_decide(at.value, spread, 0.9).value());
    }
    EXPECT_EQ(realisations_to_decide(difference, 6, 0.9).value(), most);
}

TEST(CurveVerdict, OfPairsIsSharperWherePairsAreAlike) {
    Draws random(11);
    const Curves shared = random.curves(4, points, 0.9);
    const Curves a = raised(shared, 1.0, 0.1);
    const CurveDifference paired = curve_difference(a, shared, true);
    const CurveDifference apart = curve_difference(a, shared, false);
    EXPECT_EQ(verdict_of(paired, 0.2), Verdict::same);
    EXPECT_EQ(verdict_of(apart, 0.2), Verdict::undecided);
}

TEST(MeanCurve, HasTheMeanAndItsErrorAtEachPoint) {
    const std::vector<Estimate> mean = mean_curve({{1.0, 5.0}, {3.0, 5.0}});
    ASSERT_EQ(mean.size(), 2U);
    EXPECT_DOUBLE_EQ(mean[0].value, 2.0);
    EXPECT_DOUBLE_EQ(mean[0].standard_error, 1.0);
    EXPECT_DOUBLE_EQ(mean[1].standard_error, 0.0);
}

}  // namespace
}  // namespace grainbench::statistics
