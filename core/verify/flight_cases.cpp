#include "core/verify/recurrence.hpp"
#include "core/verify/registry.hpp"
#include "core/verify/run.hpp"
#include "core/verify/scenes.hpp"

namespace grainbench::verify {

namespace {

/// Under a constant force the scheme is exact at any step, and at steps that change.
void check_free_fall(Checks& checks) {
    const Vec3 start{0.01, -0.02, 5.0};
    const Vec3 velocity{0.3, 0.0, 2.0};
    const double g = 9.8;
    for (const bool automatic : {false, true}) {
        Scene scene = scene_of({}, 1e-4, 1.0);
        if (automatic) {
            // The kinematic limit, a step that shrinks as the fall goes on, is what binds here.
            scene.timestep = automatic_step(20.0);
        }
        scene.gravity = Vec3{0.0, 0.0, -g};
        add_sphere(scene, start, velocity);
        Run run(scene);
        run.finish();
        const double t = run.simulation().time();
        const std::string by = automatic ? ", automatic step" : ", fixed step";
        const Tolerance tolerance =
            round_off(static_cast<double>(run.simulation().cycle()), start.z);
        const Ball ball = run.ball();
        checks.add("x" + by, "m", start.x + velocity.x * t, ball.position.x, tolerance);
        checks.add(
            "z" + by, "m", start.z + velocity.z * t - 0.5 * g * t * t, ball.position.z, tolerance);
        checks.add("v_z" + by, "m/s", velocity.z - g * t, ball.velocity.z, tolerance);
    }
}

constexpr double bounce_gravity = 9.81;
constexpr double bounce_height = 0.1;
constexpr double bounce_damping = 0.02;
constexpr double bounce_stiffness = 1e5;

Scene bounce_scene(double timestep, double duration) {
    Scene scene =
        scene_of({.normal = bounce_stiffness, .damping = bounce_damping, .damping_mode = 3},
                 timestep,
                 duration);
    scene.gravity = Vec3{0.0, 0.0, -bounce_gravity};
    add_plane(scene, "floor", {}, {0.0, 0.0, 1.0});
    add_sphere(scene, {0.0, 0.0, bounce_height});
    return scene;
}

double bounce_restitution() {
    const double beta = bounce_damping;
    return std::exp(-beta / std::sqrt(1.0 - beta * beta) * (pi - 2.0 * std::asin(beta)));
}

/// Heights of the apexes, from the fall time and the height at one instant of each flight.
struct Bounces {
    std::vector<double> apexes;  ///< [m]
    double contact_speed = 0.0;  ///< [m/s] at the first touch
    double last_opening = 0.0;   ///< [s]
    std::size_t count = 0;
};

Bounces follow_bounces(Run& run) {
    Bounces bounces;
    bool touching = false;
    double speed = 0.0;
    run.each_cycle([&] {
        const bool touched = touching;
        touching = run.simulation().touching_count() > 0;
        if (touching == touched) {
            if (bounces.count == 0) {
                speed = -run.ball().velocity.z;
            }
            return;
        }
        if (touching) {
            bounces.contact_speed = bounces.count == 0 ? speed : bounces.contact_speed;
            ++bounces.count;
        } else {
            const Ball ball = run.ball();
            const double rise = ball.velocity.z * ball.velocity.z / (2.0 * bounce_gravity);
            bounces.apexes.push_back(ball.position.z + rise);
            bounces.last_opening = run.simulation().time();
        }
    });
    return bounces;
}

/// The phase within a step at which the surfaces meet decides the error of each impact, so the
/// bound is the sum of the largest ones.
void check_apexes(Checks& checks) {
    const double dt = half_period(small_sphere.mass(), bounce_stiffness) / 600.0;
    Run run(bounce_scene(dt, 2.3));
    const Bounces bounces = follow_bounces(run);
    const double r = small_sphere.radius;
    const double speed = std::sqrt(2.0 * bounce_gravity * (bounce_height - r));
    checks.add("first contact speed",
               "m/s",
               speed,
               bounces.contact_speed,
               {bounce_gravity * dt, "taken at most one step before the touch"});
    const double e = bounce_restitution();
    for (const std::size_t k : {1U, 2U, 3U, 10U}) {
        const double apex = r + (bounce_height - r) * std::pow(e, 2.0 * static_cast<double>(k));
        checks.add("apex " + std::to_string(k),
                   "m",
                   apex,
                   bounces.apexes.at(k - 1),
                   relative(2e-4 * static_cast<double>(k),
                            apex,
                            "2 k times the error of e, 1e-4 at most at 600 steps"));
    }
}

/// Two bounces against the recurrence. Each multiplies a difference by about a hundred, through the
/// phase within a step at which the surfaces meet, so that ten would leave nothing to compare.
void check_scheme(Checks& checks) {
    const double dt = half_period(small_sphere.mass(), bounce_stiffness) / 200.0;
    Run run(bounce_scene(dt, 0.5));
    run.finish();
    BounceRecurrence ball{.mass = small_sphere.mass(),
                          .radius = small_sphere.radius,
                          .stiffness = bounce_stiffness,
                          .damping = bounce_damping,
                          .tension = false,
                          .gravity = bounce_gravity,
                          .height = bounce_height};
    for (std::uint64_t cycle = 0; cycle < run.simulation().cycle(); ++cycle) {
        ball.step(dt);
    }
    const Tolerance tolerance{1e-12,
                              "round-off of 1e-16 m, times a hundred in each of two bounces"};
    checks.add("height", "m", ball.height, run.ball().position.z, tolerance);
    checks.add("velocity", "m/s", ball.full_velocity(), run.ball().velocity.z, tolerance);
}

/// Time until the ball stays down: the hard-sphere series plus the durations of the impacts.
void check_total_time(Checks& checks, double beta, double k, double duration) {
    const double t_c = half_period(small_sphere.mass(), k);
    Scene scene = bounce_scene(t_c / 100.0, duration);
    scene.contact = contact_of({.normal = k, .damping = beta, .damping_mode = 3});
    Run run(scene);
    const Bounces bounces = follow_bounces(run);
    const double phase = pi - 2.0 * std::asin(beta);
    const double e = std::exp(-beta / std::sqrt(1.0 - beta * beta) * phase);
    const double fall = std::sqrt(2.0 * (bounce_height - small_sphere.radius) / bounce_gravity);
    const double hard = fall * (1.0 + e) / (1.0 - e);
    const double contact = phase / pi * t_c / std::sqrt(1.0 - beta * beta);
    checks.add("time to the last opening, beta " + text_of(beta),
               "s",
               hard + static_cast<double>(bounces.count) * contact,
               bounces.last_opening,
               relative(5e-3, hard, "weight in the last impacts, slower than a few g t_c: 20 ms"));
}

/// Time is a plain sum of steps that ends once it reaches the target (physics reference 2.6).
void check_cycle_counts(Checks& checks) {
    const std::pair<double, double> table[] = {{8e-6, 250000.0},
                                               {1e-5, 200000.0},
                                               {1.2e-5, 166667.0},
                                               {1.4e-5, 142858.0},
                                               {2e-5, 100001.0},
                                               {3e-5, 66667.0}};
    for (const auto& [dt, count] : table) {
        Scene scene = scene_of({}, dt, 2.0);
        add_sphere(scene, {});
        Run run(scene);
        run.finish();
        checks.add("cycles for 2 s at dt " + text_of(dt) + " s",
                   "1",
                   count,
                   static_cast<double>(run.simulation().cycle()),
                   exact());
    }
}

}  // namespace

std::vector<Case> flight_cases() {
    return {
        {.name = "flight/free-fall",
         .section = "10.3",
         .title = "free fall against the parabola",
         .run = check_free_fall},
        {.name = "flight/apexes",
         .section = "10.3",
         .title = "bouncing ball, heights of the apexes",
         .run = check_apexes},
        {.name = "flight/bounces-by-the-scheme",
         .section = "3.2",
         .title = "bouncing ball, step by step",
         .run = check_scheme},
        {.name = "flight/total-time",
         .section = "10.3",
         .title = "bouncing ball, time until it stays down",
         .run =
             [](Checks& checks) {
                 check_total_time(checks, bounce_damping, bounce_stiffness, 4.7);
                 check_total_time(checks, 0.2, 1e6, 0.6);
             }},
        {.name = "flight/cycle-counts",
         .section = "2.6",
         .title = "cycles of fixed steps, as in the example",
         .run = check_cycle_counts},
    };
}

}  // namespace grainbench::verify
