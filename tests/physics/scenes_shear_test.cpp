// Stresses of presets/scenes/sheared-box.json against Bagnold's scaling (Proc. R. Soc. Lond. A 225,
// 1954): at constant volume they grow with the square of the shear rate. Slow: a minute of
// processor time.

#include "tests/physics/scene_history.hpp"

#include <gtest/gtest.h>

#include <cstdio>

namespace grainbench {
namespace {

constexpr double lid_speed = 0.12;  // m/s in the slow stage
// Means are taken from a strain of 4 on, which lets a stage forget what came before it.
constexpr double slow_from = 1.0, slow_to = 3.7, fast_from = 4.1, fast_to = 5.45;  // s

/// Mean velocity along x [m/s] by height over the gap, of what lies between the layers, in slices.
std::vector<double> profile(const test::SceneHistory& run, double from, double to, int slices) {
    std::vector<double> sum(static_cast<std::size_t>(slices)), count(sum.size());
    for (const ParticleFrame& frame : run.frames) {
        if (frame.time <= from || frame.time > to) {
            continue;
        }
        double gap = 0.0;
        for (std::size_t n = 0; n < frame.size(); ++n) {
            gap = std::max(gap, frame.position[n].z);
        }
        for (std::size_t n = 0; n < frame.size(); ++n) {
            const double height = frame.position[n].z / gap;
            if (frame.species[n] < 2 && height > 0.0 && height < 1.0) {
                const auto slice = static_cast<std::size_t>(height * slices);
                sum[slice] += frame.velocity[n].x;
                count[slice] += 1.0;
            }
        }
    }
    for (std::size_t k = 0; k < sum.size(); ++k) {
        sum[k] /= count[k];
    }
    return sum;
}

TEST(ShearedBox, StressesGrowWithTheSquareOfTheRate) {
    // The forces of one box wander by a sixth over a strain of 1, so that the ratio from one run
    // has a standard error of 5 %; with three it is 3 %.
    std::vector<test::PresetRun> runs;
    for (const std::string seed : {"1", "2", "3"}) {
        runs.push_back({"sheared-box", {"/realisations/seed=" + seed}});
    }
    double pressure_slow = 0.0, pressure_fast = 0.0, shear_slow = 0.0, shear_fast = 0.0;  // N
    std::vector<double> velocity(8);                                                      // m/s
    for (const test::SceneHistory& run : test::run_presets(runs)) {
        const auto both = [&](const char* along, double from, double to) {
            return 0.5 * (run.mean(std::string("lid.force_") + along, from, to) -
                          run.mean(std::string("floor.force_") + along, from, to));
        };
        std::printf("pressure %.3f and %.3f mN, shear %.3f and %.3f mN\n",
                    1e3 * both("z", slow_from, slow_to),
                    1e3 * both("z", fast_from, fast_to),
                    -1e3 * both("x", slow_from, slow_to),
                    -1e3 * both("x", fast_from, fast_to));
        pressure_slow += both("z", slow_from, slow_to);
        pressure_fast += both("z", fast_from, fast_to);
        shear_slow -= both("x", slow_from, slow_to);
        shear_fast -= both("x", fast_from, fast_to);
        const std::vector<double> own = profile(run, slow_from, slow_to, 8);
        for (std::size_t k = 0; k < own.size(); ++k) {
            velocity[k] += own[k] / 3.0;
        }
    }
    std::printf("ratio of pressures %.3f, of shear stresses %.3f\n",
                pressure_fast / pressure_slow,
                shear_fast / shear_slow);
    EXPECT_NEAR(pressure_fast / pressure_slow, 4.0, 0.4);
    EXPECT_NEAR(shear_fast / shear_slow, 4.0, 0.4);
    for (const double friction : {shear_slow / pressure_slow, shear_fast / pressure_fast}) {
        std::printf("effective friction %.3f\n", friction);
        EXPECT_GT(friction, 0.3);
        EXPECT_LT(friction, 0.5);
    }
    // No gravity and the same stress at all heights: the shear rate is the same as well.
    std::vector<double> height;
    for (std::size_t k = 0; k < velocity.size(); ++k) {
        height.push_back((static_cast<double>(k) + 0.5) / static_cast<double>(velocity.size()));
    }
    const test::Line line = test::line_through(height, velocity);
    for (std::size_t k = 0; k < velocity.size(); ++k) {
        const double straight = line.intercept + line.slope * height[k];
        std::printf(
            "height %.4f: %.4f m/s, straight line %.4f\n", height[k], velocity[k], straight);
        EXPECT_NEAR(velocity[k], straight, 0.05 * lid_speed);
    }
}

}  // namespace
}  // namespace grainbench
