/// Effects on whole particles: local damping and driven groups.
#include "core/verify/registry.hpp"
#include "core/verify/run.hpp"
#include "core/verify/scenes.hpp"

#include <algorithm>

namespace grainbench::verify {

namespace {

constexpr double gravity = 9.8;
constexpr double stiffness = 1e5;

/// A fall loses the part alpha of its acceleration, but for the first half step, at the start of
/// which nothing moves yet.
void check_damped_fall(Checks& checks) {
    constexpr double dt = 1e-5;
    for (const double alpha : {0.1, 0.7}) {
        Scene scene = scene_of({}, dt, 0.1);
        scene.gravity = Vec3{0.0, 0.0, -gravity};
        scene.local_damping = LocalDamping{alpha};
        add_sphere(scene, {});
        Run run(scene);
        run.finish();
        const double t = run.simulation().time();
        const Tolerance late{alpha * gravity * dt, "the first half step is not damped"};
        checks.add("v_z, alpha " + text_of(alpha),
                   "m/s",
                   -gravity * (1.0 - alpha) * t,
                   run.ball().velocity.z,
                   late);
    }
}

/// A ball that swings on a floor which it never leaves: its extremes fall by one ratio, whatever
/// the frequency.
void check_damped_swing(Checks& checks) {
    const double mass = small_sphere.mass();
    const double rest = mass * gravity / stiffness;
    for (const double alpha : {0.1, 0.7}) {
        const double half = half_period(mass, stiffness);
        Scene scene = scene_of({.normal = stiffness}, half / 2000.0, 4.2 * half);
        scene.contact.normal = LinearSpring::Params{};
        scene.gravity = Vec3{0.0, 0.0, -gravity};
        scene.local_damping = LocalDamping{alpha};
        add_plane(scene, "floor", {}, {0.0, 0.0, 1.0});
        const double middle = small_sphere.radius - rest;
        add_sphere(scene, {0.0, 0.0, middle - 0.9 * rest});
        Run run(scene);
        std::vector<double> extremes{0.9 * rest};
        double speed = 0.0;
        run.each_cycle([&] {
            const Ball ball = run.ball();
            if (speed * ball.velocity.z < 0.0) {
                extremes.push_back(std::abs(ball.position.z - middle));
            }
            speed = ball.velocity.z;
        });
        const double ratio = std::sqrt((1.0 - alpha) / (1.0 + alpha));
        for (std::size_t n = 1; n < std::min<std::size_t>(extremes.size(), 4); ++n) {
            // Towards the middle (1 - alpha) of the spring acts, away from it (1 + alpha).
            checks.add("extreme " + std::to_string(n) + ", alpha " + text_of(alpha),
                       "1",
                       ratio,
                       extremes[n] / extremes[n - 1],
                       relative(5e-3, ratio, "seen within a step of 1/2000 of the half cycle"));
        }
        checks.add_claim("three extremes, alpha " + text_of(alpha), extremes.size() >= 4);
    }
}

void drive(Scene& scene, const std::string& species, const WallMotion& motion) {
    scene.groups.push_back({.name = "driven " + species, .species = species, .box = {}});
    scene.driven.push_back({.group = "driven " + species, .motion = motion});
}

/// A frozen ball is a wall to another: the same impact as on a plane, dashpots included.
void check_frozen(Checks& checks) {
    const double dt = half_period(small_sphere.mass(), stiffness) / 200.0;
    const auto scene_with = [&](bool plane) {
        Scene scene = scene_of({.normal = stiffness, .damping = 0.1, .damping_mode = 3}, dt, 0.01);
        add_sphere(scene, {0.0, 0.0, 0.0065}, {0.0, 0.0, -1.0});
        if (plane) {
            add_plane(scene, "floor", {0.0, 0.0, 0.003}, {0.0, 0.0, 1.0});
        } else {
            add_species(scene, "anchor", small_sphere);
            add_sphere(scene, {}, {}, {}, "anchor");
            drive(scene, "anchor", FixedMotion{});
        }
        return scene;
    };
    Run on_plane(scene_with(true));
    Run on_frozen(scene_with(false));
    on_plane.finish();
    on_frozen.finish();
    checks.add("velocity after the impact",
               "m/s",
               on_plane.ball().velocity.z,
               on_frozen.ball().velocity.z,
               {1e-9, "round-off of distances, 1e-18 m over an overlap of 1e-5 m, in 200 steps"});
    checks.add("place of the frozen ball", "m", 0.0, on_frozen.ball(1).position.z, exact());
}

/// A heavy paddle hits a ball at rest: 2 V without dashpots.
void check_pushed(Checks& checks) {
    Scene scene =
        scene_of({.normal = stiffness}, half_period(small_sphere.mass(), stiffness) / 1000.0, 0.01);
    add_sphere(scene, {0.0, 0.0, 0.0065});
    add_species(scene, "paddle", small_sphere);
    add_sphere(scene, {}, {}, {}, "paddle");
    drive(scene, "paddle", ConstantMotion{.velocity = {0.0, 0.0, 0.4}});
    Run run(scene);
    run.finish();
    checks.add("velocity after the impact",
               "m/s",
               0.8,
               run.ball().velocity.z,
               relative(2e-3, 0.8, "the spring opens and closes within steps"));
    checks.add("velocity of the paddle", "m/s", 0.4, run.ball(1).velocity.z, exact());
    checks.add("way of the paddle",
               "m",
               0.4 * run.simulation().time(),
               run.ball(1).position.z,
               round_off(static_cast<double>(run.simulation().cycle()), 0.01));
}

/// 100 turns leave the radius as it was.
void check_turning(Checks& checks) {
    constexpr double rate = 2.0 * pi * 50.0;
    constexpr double arm = 0.05;
    Scene scene = scene_of({}, 1e-4, 2.0);
    add_species(scene, "rotor", small_sphere);
    add_sphere(scene, {arm, 0.0, 0.01}, {}, {}, "rotor");
    scene.gravity = Vec3{0.0, 0.0, -gravity};
    drive(scene, "rotor", RotationMotion{.point = {}, .axis = {0.0, 0.0, 1.0}, .rate = rate});
    Run run(scene);
    run.finish();
    const Ball ball = run.ball();
    const double t = run.simulation().time();
    const Tolerance tolerance = round_off(static_cast<double>(run.simulation().cycle()), arm);
    checks.add("radius", "m", arm, std::hypot(ball.position.x, ball.position.y), tolerance);
    checks.add("x", "m", arm * std::cos(rate * t), ball.position.x, {1e-9, "angle: 1e-8 in 628"});
    checks.add("height, against gravity", "m", 0.01, ball.position.z, exact());
    checks.add("spin", "rad/s", rate, ball.spin.z, exact());
}

/// Thrown: driven for a while, then free; the parabola from there.
void check_released(Checks& checks) {
    constexpr double dt = 1e-4;
    Scene scene = scene_of({}, dt, 0.05);
    scene.gravity = Vec3{0.0, 0.0, -gravity};
    add_sphere(scene, {});
    scene.groups = {{.name = "ball", .species = {}, .box = {}}};
    scene.driven = {{.group = "ball", .motion = ConstantMotion{.velocity = {0.3, 0.0, 1.0}}}};
    Stage flight;
    flight.duration = 0.1;
    flight.released = {"ball"};
    scene.stages.push_back(flight);
    Run run(scene);
    while (run.simulation().stage() == 0) {
        run.advance(1);
    }
    // The step that saw the second stage begin is the first of the flight.
    run.finish();
    const double t = run.simulation().time() - 0.05;
    const Tolerance tolerance{gravity * dt * dt, "the release is found within a step"};
    const Ball ball = run.ball();
    checks.add("x", "m", 0.3 * run.simulation().time(), ball.position.x, round_off(2e3, 0.05));
    checks.add("z", "m", 0.05 + t - 0.5 * gravity * t * t, ball.position.z, tolerance);
    checks.add("v_z", "m/s", 1.0 - gravity * t, ball.velocity.z, {gravity * dt, "the same"});
}

/// What a driven group does to the others is the walls' work, and local damping has a column of its
/// own: with both on the ledger closes.
void check_body_ledger(Checks& checks) {
    Scene scene = scene_of({.normal = 1e4,
                            .shear = 1e4,
                            .incremental = true,
                            .friction = 0.5,
                            .damping = 0.1,
                            .damping_mode = 3},
                           1e-5,
                           0.2);
    scene.gravity = Vec3{0.0, 0.0, -gravity};
    scene.local_damping = LocalDamping{0.05};
    scene.observables.energy = EnergyObservable{};
    add_plane(scene, "floor", {}, {0.0, 0.0, 1.0});
    for (int n = 0; n < 8; ++n) {
        add_sphere(scene, {0.0065 * (n % 2), 0.0065 * (n / 2 % 2), 0.012 + 0.0065 * (n / 4)});
    }
    add_species(scene, "stirrer", small_sphere);
    add_sphere(scene, {0.012, 0.0, 0.004}, {}, {}, "stirrer");
    add_sphere(scene, {-0.006, 0.003, 0.004}, {}, {}, "stirrer");
    drive(scene,
          "stirrer",
          RotationMotion{.point = {0.003, 0.003, 0.0}, .axis = {0.0, 0.0, 1.0}, .rate = 40.0});
    Run run(scene);
    run.finish();
    const double work = run.now("energy_wall_work");
    checks.add_claim("the group worked on the others", work > 1e-5);
    checks.add_claim("local damping took part of it", run.now("energy_dissipated_local") > 1e-6);
    checks.add_bound("residual over the work",
                     "1",
                     1e-6,
                     run.now("energy_residual") / work,
                     "dt^2/8 of gravity times contact forces, 1e-10 J, over 1e-4 J");
}

}  // namespace

std::vector<Case> body_cases() {
    return {
        {.name = "body/damped-fall",
         .section = "3.3",
         .title = "local damping: acceleration of a fall",
         .run = check_damped_fall},
        {.name = "body/damped-swing",
         .section = "3.3",
         .title = "local damping: extremes of a swing",
         .run = check_damped_swing},
        {.name = "body/frozen",
         .section = "3.2",
         .title = "a frozen ball is a wall to another",
         .run = check_frozen},
        {.name = "body/pushed",
         .section = "3.2",
         .title = "a driven ball hits one at rest",
         .run = check_pushed},
        {.name = "body/turning",
         .section = "3.2",
         .title = "a driven ball on a circle",
         .run = check_turning},
        {.name = "body/released",
         .section = "3.2",
         .title = "a driven ball is let go",
         .run = check_released},
        {.name = "body/ledger",
         .section = "10.12",
         .title = "energies beside driven groups and local damping",
         .run = check_body_ledger},
    };
}

}  // namespace grainbench::verify
