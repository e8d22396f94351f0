#include "core/verify/registry.hpp"
#include "core/verify/run.hpp"
#include "core/verify/scenes.hpp"

namespace grainbench::verify {

namespace {

constexpr double gravity = 9.8;
constexpr double stiffness = 1e5;
constexpr double dt = 2e-6;

/// Ball at rest on the floor in its own weight's overlap; gravity tilts by `slope` towards x.
/// Without dashpots: at the start, while the shear spring is still to be loaded, they would brake
/// for a step.
Scene ground_scene(double friction, double slope, double speed, double duration) {
    Scene scene =
        scene_of({.normal = stiffness, .shear = stiffness, .friction = friction}, dt, duration);
    scene.gravity = gravity * Vec3{std::sin(slope), 0.0, -std::cos(slope)};
    add_plane(scene, "floor", {}, {0.0, 0.0, 1.0});
    const double overlap = small_sphere.mass() * gravity * std::cos(slope) / stiffness;
    add_sphere(scene, {0.0, 0.0, small_sphere.radius - overlap}, {speed, 0.0, 0.0});
    scene.output.contacts = true;
    scene.output.frame_interval = 0.5 * dt;  // contacts are looked at in any cycle
    return scene;
}

/// With dashpots, which still the ringing of the shear spring of a ball that sticks.
Contact stilling_contact(double friction) {
    return contact_of({.normal = stiffness,
                       .shear = stiffness,
                       .friction = friction,
                       .damping = 0.3,
                       .damping_mode = 3});
}

Stage stilling_stage(double friction, double duration) {
    Stage stage;
    stage.name = "stilling";
    stage.duration = duration;
    stage.contact = stilling_contact(friction);
    return stage;
}

bool slips(const Run& run, double friction) {
    const ContactFrame contacts = run.simulation().contact_frame();
    return contacts.force_tangential.at(0) > (1.0 - 1e-9) * friction * contacts.force_normal.at(0);
}

void check_sliding(Checks& checks, double friction) {
    constexpr double v0 = 1.0;
    const double r = small_sphere.radius;
    const double end = 2.0 * v0 / (7.0 * friction * gravity);
    Scene scene = ground_scene(friction, 0.0, v0, end + 10.0 * dt);
    scene.stages.push_back(stilling_stage(friction, 0.01));
    Run run(scene);
    const double energy = 0.5 * small_sphere.mass() * v0 * v0;

    run.advance(static_cast<std::uint64_t>(0.5 * end / dt));
    const double half = run.simulation().time();
    const Ball sliding = run.ball();
    const std::string label = ", mu " + text_of(friction);
    // At the start the shear spring holds nothing: no friction in the first half step.
    const Tolerance start{0.6 * friction * gravity * dt, "no friction in the first half step"};
    checks.add(
        "v halfway" + label, "m/s", v0 - friction * gravity * half, sliding.velocity.x, start);
    checks.add("R w halfway" + label,
               "m/s",
               2.5 * friction * gravity * half,
               r * sliding.spin.y,
               {2.5 * start.absolute + 2e-6, "the same, and overlap over radius, 6e-6"});

    while (slips(run, friction)) {
        run.advance(1);
    }
    const double stop = run.simulation().time();
    const double way = run.ball().position.x;
    run.finish();
    checks.add("sliding ends" + label,
               "s",
               end,
               stop,
               {3.0 * dt, "half a step at the start, two at the end"});
    checks.add("way of sliding" + label,
               "m",
               12.0 * v0 * v0 / (49.0 * friction * gravity),
               way,
               {3.0 * dt * v0, "half a step at the start, two at the end"});
    const Ball rolling = run.ball();
    const std::string reason = "overlap over radius, 6e-6, and the last of the ringing";
    checks.add("v at the end" + label,
               "m/s",
               5.0 / 7.0 * v0,
               rolling.velocity.x,
               relative(1e-5, v0, reason));
    checks.add("spin at the end" + label,
               "rad/s",
               5.0 / 7.0 * v0 / r,
               rolling.spin.y,
               relative(1e-5, v0 / r, reason));
    checks.add("kinetic energy kept" + label,
               "1",
               5.0 / 7.0,
               run.now("kinetic_energy") / energy,
               {2e-5, reason});
}

void check_incline(Checks& checks) {
    struct Row {
        const char* label;
        bool rolls;
        double friction, acceleration, spin;
    };

    const double slope = pi / 6.0;
    const double s = gravity * std::sin(slope);
    const double c = gravity * std::cos(slope);
    const double duration = 0.1;
    for (const Row& row : {Row{"rolling, mu 0.6", true, 0.6, 5.0 / 7.0 * s, 5.0 / 7.0 * s},
                           Row{"sliding, mu 0.1", false, 0.1, s - 0.1 * c, 2.5 * 0.1 * c}}) {
        Scene scene = ground_scene(row.friction, slope, 0.0, duration);
        if (row.rolls) {
            scene.contact = stilling_contact(row.friction);
        }
        Run run(scene);
        run.finish();
        const double t = run.simulation().time();
        const Ball ball = run.ball();
        const std::string reason = row.rolls
                                       ? "way of the shear spring at the start, 1e-9 m"
                                       : "sticks for 2.4e-5 s until the shear spring is loaded";
        const double fraction = row.rolls ? 2e-5 : 2.4e-4;
        checks.add(std::string("v_x, ") + row.label,
                   "m/s",
                   row.acceleration * t,
                   ball.velocity.x,
                   relative(fraction, row.acceleration * t, reason));
        checks.add(std::string("R w, ") + row.label,
                   "m/s",
                   row.spin * t,
                   small_sphere.radius * ball.spin.y,
                   relative(fraction, row.spin * t, reason));
    }
}

}  // namespace

std::vector<Case> rolling_cases() {
    return {
        {.name = "rolling/sliding-to-rolling-0.6",
         .section = "10.4",
         .title = "ball thrown along the floor, friction 0.6",
         .run = [](Checks& checks) { check_sliding(checks, 0.6); }},
        {.name = "rolling/sliding-to-rolling-0.3",
         .section = "10.4",
         .title = "ball thrown along the floor, friction 0.3",
         .run = [](Checks& checks) { check_sliding(checks, 0.3); }},
        {.name = "rolling/incline",
         .section = "10.4",
         .title = "ball on a slope of 30 degrees",
         .run = check_incline},
    };
}

}  // namespace grainbench::verify
