// How deep the ball of presets/scenes/ball-impact.json digs itself in, against the law of Uehara,
// Ambroso, Ojha and Durian (Phys. Rev. Lett. 90, 194301, 2003): depth ~ total drop^(1/3). Slow: a
// minute of processor time.

#include "tests/physics/scene_history.hpp"

#include <gtest/gtest.h>

#include <cstdio>

namespace grainbench {
namespace {

constexpr double ball = 0.004;        // m, radius
constexpr double bead = 0.001;        // m, radius
constexpr double let_go = 0.2099;     // s
constexpr double gravity = 9.81;      // m/s^2
constexpr std::int32_t of_balls = 1;  // species

std::size_t ball_of(const ParticleFrame& frame) {
    return static_cast<std::size_t>(
        std::find(frame.species.begin(), frame.species.end(), of_balls) - frame.species.begin());
}

/// Height of the surface of the bed [m]: mean top of the highest beads over squares of 4 mm, away
/// from the wall.
double surface(const ParticleFrame& frame) {
    constexpr double square = 0.004;
    std::map<std::pair<int, int>, double> top;
    for (std::size_t n = 0; n < frame.size(); ++n) {
        const Vec3& at = frame.position[n];
        if (frame.species[n] != of_balls && std::hypot(at.x, at.y) < 0.015) {
            double& highest = top[{static_cast<int>(std::floor(at.x / square)),
                                   static_cast<int>(std::floor(at.y / square))}];
            highest = std::max(highest, at.z + bead);
        }
    }
    double sum = 0.0;
    for (const auto& [place, height] : top) {
        sum += height / static_cast<double>(top.size());
    }
    return sum;
}

TEST(BallImpact, DepthGrowsWithTheCubeRootOfTheDrop) {
    std::vector<test::PresetRun> runs;
    for (const std::string speed : {"0.7", "1.4", "2", "2.8"}) {
        runs.push_back({"ball-impact", {"/driven/0/motion/speeds=[0,0,-0.4,-0.4,-" + speed + "]"}});
    }
    std::vector<double> log_drop, log_depth;
    for (const test::SceneHistory& run : test::run_presets(runs)) {
        const ParticleFrame& start =
            *std::find_if(run.frames.begin(), run.frames.end(), [](const ParticleFrame& frame) {
                return frame.time >= let_go;
            });
        const ParticleFrame& end = run.frames.back();
        const double speed = start.velocity[ball_of(start)].z;
        const double level = surface(start);
        const double rest = end.position[ball_of(end)].z;
        const double depth = level - (rest - ball);
        // All that the ball fell, from rest at the top of a free fall to rest in the bed.
        const double drop =
            speed * speed / (2.0 * gravity) + start.position[ball_of(start)].z - rest;
        std::printf("drop %.4f m, depth %.5f m, last speed %.4f m/s, level %.5f m\n",
                    drop,
                    depth,
                    end.velocity[ball_of(end)].z,
                    level);
        EXPECT_NEAR(end.velocity[ball_of(end)].z, 0.0, 0.01);
        log_drop.push_back(std::log(drop));
        log_depth.push_back(std::log(depth));
    }
    const double exponent = test::line_through(log_drop, log_depth).slope;
    std::printf("exponent %.3f\n", exponent);
    EXPECT_NEAR(exponent, 1.0 / 3.0, 0.1);
}

}  // namespace
}  // namespace grainbench
