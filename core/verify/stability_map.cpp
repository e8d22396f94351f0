#include "core/verify/stability_map.hpp"

#include "core/error.hpp"
#include "core/verify/run.hpp"
#include "core/verify/scenes.hpp"
#include "core/verify/stability/watched.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace grainbench::verify {

namespace {

constexpr double stiffness = 1e5;
const double mass = small_sphere.mass();
const double r = small_sphere.radius;

/// Overlap at which weight and spring balance: the ball swings by half of it.
const double depth = 0.01 * r;

/// Energy of (1) over that at the start, from x = 0 with some velocity.
double exact_energy(double beta, double omega_t) {
    const double decay = std::exp(-beta * omega_t);
    double x = omega_t;  // of beta = 1, in units of v0 / omega
    double v = 1.0 - omega_t;
    if (beta < 1.0) {
        const double damped = std::sqrt(1.0 - beta * beta);
        const double angle = damped * omega_t;
        x = std::sin(angle) / damped;
        v = std::cos(angle) - beta * x;
    }
    return decay * decay * (x * x + v * v);
}

MapPoint swing(double damping, double step) {
    constexpr double periods = 3.0;
    const double omega = std::sqrt(stiffness / mass);
    const double dt = step * 2.0 / omega;
    const double watched = periods * 2.0 * pi / omega;
    const auto cycles = std::max<std::uint64_t>(400, static_cast<std::uint64_t>(watched / dt));
    Scene scene =
        scene_of({.normal = stiffness, .damping = damping}, dt, static_cast<double>(cycles) * dt);
    scene.gravity = Vec3{0.0, 0.0, -stiffness * depth / mass};
    silence_guards(scene);
    add_plane(scene, "floor", {}, {0.0, 0.0, 1.0});
    const double speed = 0.5 * depth * omega;
    add_sphere(scene, {0.0, 0.0, r - depth}, {0.0, 0.0, -speed});

    MapPoint point{.damping = damping, .step = step};
    double quarter[4] = {0.0, 0.0, 0.0, 0.0};  // most energy in each quarter of the run
    Run run(scene);
    try {
        run.each_cycle([&] {
            const Ball ball = run.ball();
            const double x = omega * (ball.position.z - (r - depth));
            const double energy = (x * x + ball.velocity.z * ball.velocity.z) / (speed * speed);
            const double t = run.simulation().time();
            if (t <= watched) {
                point.energy_error = std::max(point.energy_error,
                                              std::abs(energy - exact_energy(damping, omega * t)));
            }
            double& most =
                quarter[std::min<std::uint64_t>(4 * run.simulation().cycle() / cycles, 3)];
            most = std::max(most, energy);
        });
        // Undamped and stable, the leapfrog's energy swings up to tenfold near the limit. Damped
        // and unstable, the ball may leave the plane again and again, with energies that stay.
        const bool stays = damping > 0.0 && quarter[3] > 0.05 && quarter[3] > 0.9 * quarter[2];
        point.grows = stays || *std::max_element(quarter, quarter + 4) > 100.0;
    } catch (const Error&) {
        point.grows = true;
    }
    return point;
}

Scene shaken_bed(const Timestep& timestep, std::int64_t seed) {
    Scene scene = scene_of({.normal = stiffness,
                            .shear = stiffness,
                            .incremental = true,
                            .friction = 0.6,
                            .damping = 0.2,
                            .damping_mode = 3},
                           1e-5,
                           0.2);
    scene.gravity = Vec3{0.0, 0.0, -9.8};
    scene.timestep = timestep;
    scene.observables.energy = EnergyObservable{};
    scene.realisations.seed = seed;
    silence_guards(scene);
    add_box(scene, "box", {-0.017, -0.017, 0.0}, {0.017, 0.017, 0.2});
    scene.walls.back().motion = SinusoidMotion{.velocity = {0.0, 0.0, 0.3}, .frequency = 20.0};
    scene.particles.insertion.emplace_back(LatticeInsertion{.species = "ball",
                                                            .origin = {-0.0126, -0.0126, 0.004},
                                                            .spacing = {0.0063, 0.0063, 0.0063},
                                                            .counts = {5, 5, 5},
                                                            .velocity = {},
                                                            .jitter = 1e-4});
    return scene;
}

}  // namespace

std::vector<MapPoint> stability_map(const std::vector<double>& dampings,
                                    const std::vector<double>& steps) {
    std::vector<MapPoint> points;
    for (const double damping : dampings) {
        for (const double step : steps) {
            points.push_back(swing(damping, step));
        }
    }
    return points;
}

double critical_step_ratio(double damping) {
    return std::sqrt(1.0 + damping * damping) - damping;
}

std::vector<BedPoint> shaken_bed_errors(const std::vector<double>& timesteps) {
    std::vector<BedPoint> points;
    for (const double timestep : timesteps) {
        BedPoint point{.timestep = timestep};
        for (const std::int64_t seed : {1, 2}) {
            try {
                Run run(shaken_bed(FixedTimestep{.value = timestep}, seed));
                run.finish();
                const double lost =
                    run.now("energy_dissipated_slip") + run.now("energy_dissipated_dashpot");
                point.energy_error += 0.5 * std::abs(run.now("energy_numerical")) / lost;
            } catch (const Error&) {
                point.energy_error = std::numeric_limits<double>::quiet_NaN();
            }
        }
        points.push_back(point);
    }
    return points;
}

double shaken_bed_automatic_step() {
    Run run(shaken_bed(automatic_step(0.8), 1));
    run.finish();
    return run.simulation().summary().mean_timestep;
}

}  // namespace grainbench::verify
