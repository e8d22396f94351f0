#include "core/verify/registry.hpp"
#include "core/verify/run.hpp"
#include "core/verify/scenes.hpp"

namespace grainbench::verify {

namespace {

constexpr double stiffness = 1e5;
constexpr double v0 = 1.0;

/// `count` balls along x with gaps between their surfaces; the first moves at v0.
Scene cradle(std::size_t count, double gap, double dt, double duration) {
    Scene scene = scene_of({.normal = stiffness}, dt, duration);
    const double spacing = 2.0 * small_sphere.radius + gap;
    for (std::size_t n = 0; n < count; ++n) {
        add_sphere(
            scene, {spacing * static_cast<double>(n), 0.0, 0.0}, {n == 0 ? v0 : 0.0, 0.0, 0.0});
    }
    return scene;
}

/// Half the period of two balls against each other [s].
double pair_duration() {
    return half_period(0.5 * small_sphere.mass(), stiffness);
}

void check_momentum_and_energy(Checks& checks, const Run& run, std::size_t count, double energy) {
    double momentum = 0.0;
    double squares = 0.0;
    for (std::size_t n = 0; n < count; ++n) {
        const double v = run.ball(n).velocity.x;
        momentum += v;
        squares += v * v;
    }
    const std::string label = ", " + std::to_string(count) + " balls";
    checks.add("momentum over m v0" + label, "1", 1.0, momentum, round_off(1e5, 1.0));
    checks.add("energy over m v0^2 / 2" + label,
               "1",
               1.0,
               squares,
               {energy, "what the scheme makes where contacts open and close"});
}

void check_spaced(Checks& checks) {
    constexpr std::size_t count = 5;
    // Wider than the depth of an impact, 2.9e-5 m, so that only two balls ever touch.
    constexpr double gap = 1e-4;
    const double dt = pair_duration() / 4000.0;
    Run run(cradle(count, gap, dt, 4.0 * (gap / v0 + pair_duration()) + 0.5 * gap / v0));
    run.finish();
    const Tolerance tolerance{1e-9, "third order in dt: 3e-11 at 4000 steps in an impact"};
    for (std::size_t n = 0; n < count; ++n) {
        checks.add("v of ball " + std::to_string(n + 1),
                   "m/s",
                   n + 1 == count ? v0 : 0.0,
                   run.ball(n).velocity.x,
                   tolerance);
    }
    check_momentum_and_energy(checks, run, count, 1e-9);
}

void check_touching(Checks& checks) {
    const std::vector<std::vector<double>> table = {
        {-0.13026, 0.15023, 0.98003},
        {-0.13228, -0.06497, 0.23698, 0.96027},
        {-0.13228, -0.07533, -0.03101, 0.29622, 0.94240}};
    const double dt = pair_duration() / 2000.0;
    for (const std::vector<double>& row : table) {
        Run run(cradle(row.size(), 0.0, dt, 20.0 * pair_duration()));
        run.finish();
        for (std::size_t n = 0; n < row.size(); ++n) {
            checks.add("v of ball " + std::to_string(n + 1) + " of " + std::to_string(row.size()),
                       "m/s",
                       row[n] * v0,
                       run.ball(n).velocity.x,
                       {1e-5, "the last printed digit"});
        }
        check_momentum_and_energy(checks, run, row.size(), 1e-6);
    }
}

}  // namespace

std::vector<Case> cradle_cases() {
    return {
        {.name = "cradle/spaced",
         .section = "10.5",
         .title = "Newton's cradle with gaps: the last ball takes all",
         .run = check_spaced},
        {.name = "cradle/touching",
         .section = "10.5",
         .title = "Newton's cradle without gaps, linear springs",
         .run = check_touching},
    };
}

}  // namespace grainbench::verify
