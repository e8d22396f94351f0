// Apparent mass on the bottom of presets/scenes/janssen-silo.json against Janssen's formula
// (Zeitschrift des Vereins Deutscher Ingenieure 39, 1895). Slow: a minute of processor time.

#include "tests/physics/scene_history.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

namespace grainbench {
namespace {

constexpr double gravity = 9.81;                                            // m/s^2
constexpr double bead_mass = 2500.0 * 4.0 / 3.0 * std::numbers::pi * 1e-9;  // kg

/// Janssen's apparent mass of a filling, both over the saturated one.
double janssen(double filling) {
    return 1.0 - std::exp(-filling);
}

TEST(Janssen, ApparentMassSaturates) {
    const std::vector<int> counts{500, 1000, 2000, 3500, 5000};
    std::vector<test::PresetRun> runs;
    for (const int count : counts) {
        runs.push_back({"janssen-silo", {"/particles/insertion/0/count=" + std::to_string(count)}});
    }
    const std::vector<test::SceneHistory> histories = test::run_presets(runs);
    std::vector<double> filled, carried;
    for (std::size_t n = 0; n < counts.size(); ++n) {
        // Two bead radii of sinking mobilise the wall; the mean is over three diameters more.
        const test::SceneHistory& run = histories[n];
        const double end = run.column("time").back();
        ASSERT_EQ(run.frames.back().size(), static_cast<std::size_t>(counts[n]));
        filled.push_back(counts[n] * bead_mass);
        carried.push_back(-run.mean("bottom.force_z", end - 0.3, end) / gravity);
        const double wall = -run.mean("silo.force_z", end - 0.3, end) / gravity;
        std::printf(
            "filled %.4f kg, bottom %.5f kg, wall %.5f kg\n", filled.back(), carried.back(), wall);
        // The beads as a whole sink without acceleration.
        EXPECT_NEAR(carried.back() + wall, filled.back(), 0.01 * filled.back());
    }
    // Least squares for the one number that the formula has.
    double saturated = 0.0, least = 1e300;
    for (double trial = 0.2 * carried.back(); trial < 2.0 * carried.back(); trial *= 1.001) {
        double sum = 0.0;
        for (std::size_t n = 0; n < counts.size(); ++n) {
            const double miss = carried[n] - trial * janssen(filled[n] / trial);
            sum += miss * miss;
        }
        if (sum < least) {
            least = sum;
            saturated = trial;
        }
    }
    const double residual = std::sqrt(least / static_cast<double>(counts.size() - 1)) / saturated;
    std::printf("saturated mass %.5f kg, residual %.1f %% of it\n", saturated, 100.0 * residual);
    EXPECT_LT(residual, 0.05);
}

}  // namespace
}  // namespace grainbench
