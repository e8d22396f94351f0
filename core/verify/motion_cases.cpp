#include "core/verify/registry.hpp"
#include "core/verify/run.hpp"
#include "core/verify/scenes.hpp"

#include <algorithm>

namespace grainbench::verify {

namespace {

/// The example's shaking, of a wall far from everything (physics reference 6).
struct Shaking {
    double frequency, amplitude;
    double stroke, stroke_digit;              ///< [m]
    double acceleration, acceleration_digit;  ///< [m/s^2] of the table
};

/// Speed of the continuous flank at s = t/T.
double flank(const Shaking& shaking, double s) {
    return shaking.amplitude / (1.0 + std::exp(-130.0 * (s - 0.055)));
}

void check_shaking(Checks& checks, const Shaking& shaking) {
    const double period = 1.0 / shaking.frequency;
    // 100 steps in each interval of the table, whose nodes are then met up to round-off.
    constexpr double steps = 20000.0;
    const double dt = period / steps;
    Scene scene = scene_of({}, dt, (steps - 0.5) * dt);
    add_plane(scene, "wall", {}, {0.0, 0.0, 1.0});
    scene.walls.back().motion =
        SmoothedSquareMotion{.frequency = shaking.frequency, .amplitude = shaking.amplitude};
    add_sphere(scene, {0.0, 0.0, 1.0});
    scene.observables.wall_forces = WallForceObservable{};
    scene.output.history_cycles = 1;
    Run run(scene);
    run.finish();
    const std::vector<double> way = run.series("wall.displacement_z");

    // Velocity in each step; the wall moves by its velocity at the start of the step.
    std::vector<double> speed;
    for (std::size_t n = 1; n < way.size(); ++n) {
        speed.push_back((way[n] - way[n - 1]) / dt);
    }
    const auto at = [&](double s) { return speed.at(static_cast<std::size_t>(s * steps + 0.5)); };
    const Tolerance round{1e-9 * shaking.amplitude, "differences of rounded displacements"};
    checks.add(
        "peak speed",
        "m/s",
        shaking.amplitude,
        *std::max_element(speed.begin(), speed.end()),
        {3e-11 * shaking.amplitude + round.absolute, "the flank's tail, 2e-11 of the amplitude"});
    for (const double s : {0.0, 0.495, 0.5, 0.505}) {
        checks.add("speed at t/T = " + text_of(s), "m/s", 0.0, at(s), round);
    }
    for (const double s : {0.05, 0.055, 0.06, 0.1}) {
        checks.add("speed at t/T = " + text_of(s), "m/s", flank(shaking, s), at(s), round);
    }
    checks.add("speed at t/T = 0.44, mirrored", "m/s", 0.5 * shaking.amplitude, at(0.44), round);
    checks.add("speed at t/T = 0.945, reversed", "m/s", -0.5 * shaking.amplitude, at(0.945), round);
    checks.add("stroke",
               "m",
               shaking.stroke,
               *std::max_element(way.begin(), way.end()),
               {shaking.stroke_digit, "half of the last printed digit"});
    checks.add("displacement after one period",
               "m",
               0.0,
               way.back(),
               {1e-6 * shaking.stroke, "forward steps from a speed of 0 to a speed of 0"});
    double steepest = 0.0;
    for (std::size_t n = 1; n < speed.size(); ++n) {
        steepest = std::max(steepest, std::abs(speed[n] - speed[n - 1]) / dt);
    }
    checks.add("peak acceleration",
               "m/s^2",
               shaking.acceleration,
               steepest,
               {shaking.acceleration_digit, "half of the last printed digit"});
    double square = 0.0;
    for (const double v : speed) {
        square += v * v / steps;
    }
    // The straight pieces of the table; the continuous flanks, which the reference gives, have
    // 0.8598.
    checks.add("rms speed over the amplitude",
               "1",
               0.859577,
               std::sqrt(square) / shaking.amplitude,
               {1e-6, "last printed digit"});
}

}  // namespace

std::vector<Case> motion_cases() {
    return {
        {.name = "motion/shaking-10-hz",
         .section = "6",
         .title = "smoothed square wave, 10 Hz and 0.35 m/s",
         .run =
             [](Checks& checks) {
                 check_shaking(checks, {10.0, 0.35, 13.474e-3, 5e-7, 109.91, 5e-3});
             }},
        {.name = "motion/shaking-100-hz",
         .section = "6",
         .title = "smoothed square wave, 100 Hz and 1.2 m/s",
         .run =
             [](Checks& checks) {
                 check_shaking(checks, {100.0, 1.2, 4.6198e-3, 5e-8, 3768.3, 5e-2});
             }},
    };
}

}  // namespace grainbench::verify
