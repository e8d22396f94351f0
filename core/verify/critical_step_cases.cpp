#include "core/verify/registry.hpp"
#include "core/verify/run.hpp"
#include "core/verify/scenes.hpp"

#include <array>
#include <utility>

namespace grainbench::verify {

namespace {

constexpr double stiffness = 1e5;
const double mass = small_sphere.mass();

/// Springs to the walls of a chain whose ends are free: only there to press it together.
constexpr double soft = 1e-5 * stiffness;

enum class Ends { free_ends, fixed_ends };

struct Chain {
    Ends ends;
    std::size_t count;
    double critical;  ///< [s] printed in the reference
};

/// Shape of the highest mode, largest entry near 1.
std::vector<double> highest_mode(const Chain& chain) {
    const double n = static_cast<double>(chain.count);
    std::vector<double> shape;
    for (std::size_t j = 0; j < chain.count; ++j) {
        const double place = static_cast<double>(j);
        shape.push_back(chain.ends == Ends::free_ends
                            ? std::cos(pi * (n - 1.0) * (place + 0.5) / n)
                            : std::sin(pi * n * (place + 1.0) / (n + 1.0)));
    }
    return shape;
}

/// Physics reference 10.9.
double highest_omega(const Chain& chain) {
    const double n = static_cast<double>(chain.count);
    const double factor =
        chain.ends == Ends::free_ends ? std::cos(0.5 * pi / n) : std::sin(0.5 * pi * n / (n + 1.0));
    return 2.0 * std::sqrt(stiffness / mass) * factor;
}

/// Overlaps at rest: between balls, and at the walls. Soft walls press with a third of the radius.
struct Squeeze {
    double pair, wall;
};

Squeeze squeeze_of(Ends ends) {
    const double deep = 1e-3;
    return ends == Ends::free_ends ? Squeeze{deep * soft / stiffness, deep} : Squeeze{1e-6, 1e-6};
}

std::vector<double> rest_positions(const Chain& chain) {
    const Squeeze squeeze = squeeze_of(chain.ends);
    std::vector<double> positions;
    for (std::size_t j = 0; j < chain.count; ++j) {
        positions.push_back(small_sphere.radius - squeeze.wall +
                            static_cast<double>(j) * (2.0 * small_sphere.radius - squeeze.pair));
    }
    return positions;
}

/// Chain along x between two planes, at rest but for `amplitude` times its highest mode.
Scene chain_scene(const Chain& chain, double amplitude, double dt, double steps) {
    Scene scene = scene_of({.normal = stiffness}, dt, (steps + 0.5) * dt);
    const std::vector<double> rest = rest_positions(chain);
    const std::vector<double> shape = highest_mode(chain);
    const double end = rest.back() + small_sphere.radius - squeeze_of(chain.ends).wall;
    add_plane(scene, "left", {}, {1.0, 0.0, 0.0});
    add_plane(scene, "right", {end, 0.0, 0.0}, {-1.0, 0.0, 0.0});
    if (chain.ends == Ends::free_ends) {
        set_stiffness(scene, "ball", "left", soft);
        set_stiffness(scene, "ball", "right", soft);
    }
    for (std::size_t j = 0; j < chain.count; ++j) {
        add_sphere(scene, {rest[j] + amplitude * shape[j], 0.0, 0.0});
    }
    return scene;
}

/// Amplitude of the highest mode, by projection.
double mode_amplitude(const Chain& chain, const Run& run) {
    const std::vector<double> rest = rest_positions(chain);
    const std::vector<double> shape = highest_mode(chain);
    const ParticleFrame frame = run.simulation().particle_frame();
    double projection = 0.0;
    double square = 0.0;
    for (std::size_t j = 0; j < chain.count; ++j) {
        projection += shape[j] * (frame.position[j].x - rest[j]);
        square += shape[j] * shape[j];
    }
    return projection / square;
}

/// omega from three successive amplitudes: x(n+1) + x(n-1) = (2 - omega^2 dt^2) x(n), whether the
/// scheme is stable or not.
double omega_of(double before, double at, double after, double dt) {
    return std::sqrt(2.0 - (before + after) / at) / dt;
}

std::string label_of(const Chain& chain) {
    return std::string(chain.ends == Ends::free_ends ? "free, " : "fixed, ") + "N " +
           std::to_string(chain.count);
}

/// The contacts stay closed below this amplitude.
double open_limit(const Chain& chain) {
    return 0.25 * squeeze_of(chain.ends).pair;
}

void check_bounded(Checks& checks, const Chain& chain, double omega) {
    const double dt = 0.99 * 2.0 / omega;
    const double amplitude = 0.1 * open_limit(chain);
    Run run(chain_scene(chain, amplitude, dt, 20000.0));
    double largest = 0.0;
    run.each_cycle([&] { largest = std::max(largest, std::abs(mode_amplitude(chain, run))); });
    checks.add("largest amplitude in 20000 steps at 0.99 of the critical step, " + label_of(chain),
               "1",
               1.0,
               largest / amplitude,
               {1e-3, "springs to the walls, 1e-5 of the others, and round-off of positions"});
}

void check_growing(Checks& checks, const Chain& chain, double omega) {
    const double dt = 1.01 * 2.0 / omega;
    const double amplitude = 1e-3 * open_limit(chain);
    Run run(chain_scene(chain, amplitude, dt, 100.0));
    run.advance(0);
    // cosh(growth) = omega^2 dt^2 / 2 - 1: 0.283 a step, 1e-3 to 0.3 of the limit in 20 steps.
    constexpr int steps = 20;
    std::vector<double> amplitudes;
    for (int n = 0; n <= steps; ++n) {
        amplitudes.push_back(mode_amplitude(chain, run));
        run.advance(1);
    }
    const double cosh_growth = 0.5 * omega * omega * dt * dt - 1.0;
    const double expected = std::cosh(steps * std::acosh(cosh_growth));
    checks.add("growth in 20 steps at 1.01 of the critical step, " + label_of(chain),
               "1",
               expected,
               std::abs(amplitudes.back()) / amplitude,
               relative(1e-3, expected, "springs to the walls, 20 steps of round-off"));
    const double measured =
        omega_of(amplitudes[steps - 2], amplitudes[steps - 1], amplitudes[steps], dt);
    checks.add("critical step from the growth, " + label_of(chain),
               "s",
               chain.critical,
               2.0 / measured,
               relative(2e-5, chain.critical, "springs to the walls, and five printed digits"));
}

void check_chains(Checks& checks, const std::vector<Chain>& chains) {
    for (const Chain& chain : chains) {
        const double omega = highest_omega(chain);
        check_bounded(checks, chain, omega);
        check_growing(checks, chain, omega);
    }
}

/// One ball pressed by its weight onto one spring, with or without a dashpot.
///
/// Model    x(n+1) = (2 - w^2 dt^2 - 2 b w dt) x(n) - (1 - 2 b w dt) x(n-1)                 (1)
///          stable for w dt < 2 (sqrt(1 + b^2) - b)                                         (2)
/// Source   physics reference 3.2, 2.2: (1) with the dashpot on the velocity half a step back.
void check_dashpot(Checks& checks) {
    const double omega = std::sqrt(stiffness / mass);
    const double overlap = 1e-6;
    const double rest = small_sphere.radius - overlap;
    for (const double beta : {0.0, 0.02, 0.3}) {
        const double critical = 2.0 / omega * (std::sqrt(1.0 + beta * beta) - beta);
        for (const double factor : {0.99, 1.01}) {
            const double dt = factor * critical;
            Laws laws{.normal = stiffness};
            if (beta > 0.0) {
                laws.damping = beta;
            }
            Scene scene = scene_of(laws, dt, 1000.0 * dt);
            scene.gravity = Vec3{0.0, 0.0, -stiffness * overlap / mass};
            add_plane(scene, "floor", {}, {0.0, 0.0, 1.0});
            const double amplitude = 1e-4 * overlap;
            add_sphere(scene, {0.0, 0.0, rest + amplitude});
            Run run(scene);
            constexpr int steps = 20;
            run.advance(steps);
            // The first step is from rest and has but half a kick.
            double x = amplitude;
            double v = 0.0;
            for (int n = 0; n < steps; ++n) {
                const double kick = n == 0 ? 0.5 * dt : dt;
                v -= (omega * omega * x + (n == 0 ? 0.0 : 2.0 * beta * omega * v)) * kick;
                x += v * dt;
            }
            const std::string label = "x after 20 steps over x(0), beta " + text_of(beta) + ", " +
                                      text_of(factor) + " of the critical step";
            checks.add(label,
                       "1",
                       x / amplitude,
                       (run.ball().position.z - rest) / amplitude,
                       {1e-5 * std::max(1.0, std::abs(x / amplitude)),
                        "position rounded to 4e-19 m, 4e-9 of the amplitude, times the growth"});
        }
    }
}

/// Tangential oscillation of a sticking contact, started in its pure mode: force S, v' = S/m and
/// R w' = -5/2 S/m, so that velocities follow v(n) = v(0) cosh(n growth) above the critical step.
/// \param compliance mass over effective mass of the mode: 7 for a pair, 3.5 on a wall
void check_stick(Checks& checks, bool pair, double compliance, double printed) {
    const double omega = std::sqrt(compliance * stiffness / mass);
    const double r = small_sphere.radius;
    const double speed = 1e-7;
    const double spin = -2.5 * speed / r;
    for (const double factor : {0.99, 1.01}) {
        const double dt = factor * 2.0 / omega;
        constexpr int steps = 20;
        Scene scene = scene_of(
            {.normal = stiffness, .shear = stiffness, .friction = 1e6}, dt, 2.0 * steps * dt);
        if (pair) {
            const double pressed = 1e-3;
            const double x = 0.5 * (2.0 * r - pressed * soft / stiffness);
            const double wall = x + r - pressed;
            add_plane(scene, "left", {-wall, 0.0, 0.0}, {1.0, 0.0, 0.0});
            add_plane(scene, "right", {wall, 0.0, 0.0}, {-1.0, 0.0, 0.0});
            set_stiffness(scene, "ball", "left", soft);
            set_stiffness(scene, "ball", "right", soft);
            add_sphere(scene, {-x, 0.0, 0.0}, {0.0, -speed, 0.0}, {0.0, 0.0, spin});
            add_sphere(scene, {x, 0.0, 0.0}, {0.0, speed, 0.0}, {0.0, 0.0, spin});
        } else {
            const double overlap = 1e-8;
            scene.gravity = Vec3{-stiffness * overlap / mass, 0.0, 0.0};
            add_plane(scene, "left", {}, {1.0, 0.0, 0.0});
            add_sphere(scene, {r - overlap, 0.0, 0.0}, {0.0, speed, 0.0}, {0.0, 0.0, spin});
        }
        Run run(scene);
        std::vector<double> v;
        for (int n = 0; n <= steps; ++n) {
            run.advance(n == 0 ? 0 : 1);
            v.push_back(run.ball(pair ? 1 : 0).velocity.y);
        }
        const double sum = 2.0 - omega * omega * dt * dt;
        double before = speed;
        double now = 0.5 * sum * speed;
        for (int n = 1; n < steps; ++n) {
            before = std::exchange(now, sum * now - before);
        }
        const std::string label =
            "v after 20 steps over v(0) at " + text_of(factor) + " of the critical step";
        const double scale = std::max(1.0, std::abs(now / speed));
        checks.add(label,
                   "1",
                   now / speed,
                   v.back() / speed,
                   {1e-3 * scale,
                    "lever arm shorter by half an overlap, 1.7e-6, times 280 so near the limit"});
        checks.add(
            factor < 1.0 ? "critical step from the oscillation" : "critical step from the growth",
            "s",
            printed,
            2.0 / omega_of(v[steps - 2], v[steps - 1], v[steps], dt),
            relative(2e-5, printed, "lever arm, and five printed digits"));
    }
}

}  // namespace

std::vector<Case> critical_step_cases() {
    return {
        {.name = "critical-step/free-chain",
         .section = "10.9",
         .title = "chains with free ends around their critical step",
         .run =
             [](Checks& checks) {
                 check_chains(checks,
                              {{Ends::free_ends, 2, 5.8249e-5},
                               {Ends::free_ends, 3, 4.7560e-5},
                               {Ends::free_ends, 5, 4.3308e-5},
                               {Ends::free_ends, 10, 4.1702e-5}});
             }},
        {.name = "critical-step/fixed-chain",
         .section = "10.9",
         .title = "chains between walls around their critical step",
         .run =
             [](Checks& checks) {
                 check_chains(checks,
                              {{Ends::fixed_ends, 1, 5.8249e-5},
                               {Ends::fixed_ends, 3, 4.4582e-5},
                               {Ends::fixed_ends, 10, 4.1612e-5}});
             }},
        {.name = "critical-step/dashpot",
         .section = "10.9",
         .title = "one ball on a spring and a dashpot",
         .run = check_dashpot},
        {.name = "critical-step/sticking-pair",
         .section = "10.9",
         .title = "two balls that stick, shaken tangentially",
         .run = [](Checks& checks) { check_stick(checks, true, 7.0, 3.1135e-5); }},
        {.name = "critical-step/sticking-wall",
         .section = "2.3",
         .title = "a ball that sticks to a wall, shaken tangentially",
         .run = [](Checks& checks) { check_stick(checks, false, 3.5, 4.40316e-5); }},
    };
}

}  // namespace grainbench::verify
