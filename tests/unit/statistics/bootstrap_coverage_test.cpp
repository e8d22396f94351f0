// Slow: ten thousand draws, each of which draws its curves again two hundred times.
#include "tests/unit/statistics/draws.hpp"

#include <gtest/gtest.h>

namespace grainbench::statistics {
namespace {

TEST(BootstrapCoverage, OfABandOverAWholeCurveIsNearNominal) {
    // With as many curves as the study asks for at least, the bootstrap is a little too careful
    // (0.966); it comes down to its level as they grow in number. Frequencies over 10 000 draws
    // have a standard error of 0.002.
    EXPECT_NEAR(coverage_of_band(24, 0.9, 10'000), 0.95, 0.01);
    EXPECT_NEAR(coverage_of_band(fewest_for_bootstrap, 0.9, 10'000), 0.96, 0.02);
}

}  // namespace
}  // namespace grainbench::statistics
