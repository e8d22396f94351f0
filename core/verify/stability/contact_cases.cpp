// Impacts, overlaps and ratios far from the usual.
#include "core/verify/registry.hpp"
#include "core/verify/scenes.hpp"
#include "core/verify/stability/watched.hpp"

#include <algorithm>
#include <array>

namespace grainbench::verify {

namespace {

constexpr double stiffness = 1e5;
const double mass = small_sphere.mass();
const double r = small_sphere.radius;
const double contact_time = half_period(0.5 * mass, stiffness);

Vec3 momentum_of(const Run& run) {
    Vec3 sum{};
    for (const Vec3& v : run.simulation().particle_frame().velocity) {
        sum += mass * v;
    }
    return sum;
}

/// Two balls along x that meet at `speed`, each with half of it.
Scene head_on(const Laws& laws, double speed, double dt, double duration) {
    Scene scene = scene_of(laws, dt, duration);
    const double gap = 1e-6;
    add_sphere(scene, {-r - 0.5 * gap, 0.0, 0.0}, {0.5 * speed, 0.0, 0.0});
    add_sphere(scene, {r + 0.5 * gap, 0.0, 0.0}, {-0.5 * speed, 0.0, 0.0});
    return scene;
}

void check_damping(Checks& checks) {
    for (const int mode : {0, 1, 2, 3}) {
        double gained = 0.0;
        double before = 2.0;
        bool falls = true;
        for (int n = 0; n <= 20; ++n) {
            Laws laws{.normal = stiffness, .damping_mode = mode};
            laws.damping = 0.05 * n;
            Run run(head_on(laws, 1.0, contact_time / 100.0, 5.0 * contact_time));
            run.finish();
            const double back = run.ball(1).velocity.x - run.ball(0).velocity.x;
            gained = std::max(gained, std::abs(back) - 1.0);
            falls = falls && back < before;
            before = back;
        }
        checks.add_bound("restitution over 1 at ratios 0 to 1, mode " + std::to_string(mode),
                         "1",
                         1e-3,
                         gained,
                         "an undamped impact of 100 steps returns 1 to that");
        checks.add_claim("restitution falls with each damping ratio, mode " + std::to_string(mode),
                         falls);
    }
}

/// What half of the relative distance of the centres leaves of the pair's energy.
void check_overlaps(Checks& checks) {
    for (const double overlap : {0.01, 0.03, 0.1, 0.3, 1.0, 1.9, 1.999, 2.0}) {
        Scene scene = scene_of({.normal = stiffness}, contact_time / 400.0, 2.0 * contact_time);
        add_sphere(scene, {0.0, 0.0, 0.0});
        add_sphere(scene, {(2.0 - overlap) * r, 0.0, 0.0});
        const std::string label = ", overlap " + text_of(overlap) + " of a radius";
        if (overlap > scene.guards.overlap.bound) {
            const Ending ending = watch(scene, 1);
            checks.add_claim("refused" + label, ending.stopped);
        }
        if (overlap == 2.0) {
            continue;  // no direction to part in
        }
        silence_guards(scene);
        Run run(scene);
        run.finish();
        const double energy = 0.5 * stiffness * overlap * overlap * r * r;
        checks.add_bound("energy of flight over that of the spring, less 1" + label,
                         "1",
                         0.02,
                         run.now("kinetic_energy") / energy - 1.0,
                         "400 steps in half a period");
        checks.add_bound("momentum over that of one ball" + label,
                         "1",
                         1e-12,
                         norm(momentum_of(run)) / std::sqrt(2.0 * mass * energy),
                         "round-off of equal and opposite forces");
    }
}

/// One scene: radii 1 and 100 mm, densities 10 and 1e4, stiffness 1e2 and 1e6.
void check_ratios(Checks& checks) {
    const Sphere tiny{.radius = 0.001, .density = 10.0};
    const Sphere huge{.radius = 0.1, .density = 1e4};
    Scene scene = scene_of({.normal = 1e2, .shear = 1e2, .friction = 0.5, .damping = 0.3},
                           1e-5,
                           checks.is_full() ? 4.0 : 1.0,
                           tiny);
    scene.timestep = automatic_step(0.5);
    add_species(scene, "huge", huge);
    scene.gravity = Vec3{0.0, 0.0, -9.8};
    add_plane(scene, "floor", {}, {0.0, 0.0, 1.0});
    set_stiffness(scene, "huge", "floor", 1e6, 1e6);
    set_stiffness(scene, "huge", "huge", 1e6, 1e6);
    add_sphere(scene, {0.0, 0.0, huge.radius}, {}, {}, "huge");
    const double drop = 0.01;
    for (int n = 0; n < 8; ++n) {
        const double x = 0.12 + 0.004 * n;
        add_sphere(scene, {x, 0.0, tiny.radius + drop});
    }
    add_sphere(scene, {0.0, 0.0, 2.0 * huge.radius + tiny.radius + drop});
    Run run(scene);
    const Ending ending = watch(run, ~std::uint64_t{0});
    checks.add_claim("runs to its end", !ending.stopped);
    const double energy = huge.mass() * 9.8 * drop;
    checks.add_bound("kinetic energy left over that of a fall",
                     "1",
                     1e-8,
                     run.now("kinetic_energy") / energy,
                     "settles");
    checks.add_bound("warnings of guards",
                     "1",
                     0.0,
                     static_cast<double>(run.simulation().summary().warnings.size()),
                     "nothing left, nothing deep");
}

/// Speeds up to many radii in a step against a plane, a disc and another ball.
void check_speeds(Checks& checks) {
    const double dt = 1e-6;
    const char* names[] = {"plane", "disc", "ball"};
    for (int target = 0; target < 3; ++target) {
        int silent = 0;
        int caught = 0;
        int refused = 0;
        for (const double way :
             {0.01, 0.03, 0.1, 0.2, 0.3, 0.45, 0.6, 0.8, 1.0, 1.5, 2.0, 2.5, 10.0, 1e3, 1e6}) {
            for (const double phase : {0.0, 0.25, 0.5, 0.75}) {
                const double speed = way * r / dt;
                // As stiff as the step allows, lest the spring give way.
                Scene scene = scene_of({.normal = 0.2 * mass / (dt * dt)}, dt, 64.0 * dt);
                scene.timestep = FixedTimestep{.value = dt};
                double start = 0.0;
                if (target == 0) {
                    add_plane(scene, "target", {}, {1.0, 0.0, 0.0});
                    start = r;
                } else if (target == 1) {
                    Wall disc;
                    disc.name = "target";
                    disc.shape = Disc{.centre = {}, .normal = {1.0, 0.0, 0.0}, .radius = 10.0 * r};
                    scene.walls.push_back(disc);
                    start = r;
                } else {
                    add_sphere(scene, {});
                    start = 2.0 * r;
                }
                add_sphere(scene, {start + (2.0 + phase) * way * r, 0.0, 0.0}, {-speed, 0.0, 0.0});
                Run run(scene);
                const Ending ending = watch(run, 64);
                const bool told = !run.simulation().summary().warnings.empty();
                const std::size_t flier = target == 2 ? 1 : 0;
                const bool passed =
                    run.ball(flier).position.x < (target == 2 ? run.ball(0).position.x : 0.0);
                refused += ending.stopped ? 1 : 0;
                caught += !ending.stopped && !passed ? 1 : 0;
                silent += !ending.stopped && passed && !told ? 1 : 0;
            }
        }
        const std::string label = std::string(", on a ") + names[target];
        checks.add_bound("passed through unseen, of 60" + label,
                         "1",
                         0.0,
                         silent,
                         "caught or refused, never silent");
        checks.add_claim("some are caught and some refused" + label, caught > 0 && refused > 0);
    }
}

void check_oblique(Checks& checks) {
    double most = -1.0;
    int runs = 0;
    for (const double friction : {0.05, 0.2, 0.5, 1.0, 2.0}) {
        for (int n = 0; n < 20; ++n) {
            const double angle = (n + 0.5) / 20.0 * 0.5 * pi;
            for (const double spin : {0.0, 300.0, -300.0}) {
                const double dt = half_period(mass, stiffness) / 400.0;
                Scene scene =
                    scene_of({.normal = stiffness, .shear = 0.8 * stiffness, .friction = friction},
                             dt,
                             600.0 * dt);
                add_plane(scene, "floor", {}, {0.0, 0.0, 1.0});
                add_sphere(scene,
                           {0.0, 0.0, r + 1e-6},
                           {std::sin(angle), 0.0, -std::cos(angle)},
                           {0.0, spin, 0.0});
                Run run(scene);
                run.advance(0);
                const double before = run.now("kinetic_energy");
                run.finish();
                if (run.simulation().touching_count() > 0) {
                    continue;  // grazing ones are not off yet: their energy is in the spring
                }
                most = std::max(most, run.now("kinetic_energy") / before - 1.0);
                ++runs;
            }
        }
    }
    checks.add_bound("largest gain of energy, of what came in",
                     "1",
                     1e-5,
                     std::max(most, 0.0),
                     "order (dt / contact time)^2 at 400 steps");
    checks.add_claim("at least 270 of 300 impacts were over", runs >= 270);
}

/// A pair that touches midway between two searches, `cycles` apart.
void check_late(Checks& checks) {
    const double dt = contact_time / 400.0;
    const double speed = 1.0;
    for (const std::int64_t cycles : {1, 2, 5, 10, 20, 50, 100}) {
        for (const bool incremental : {true, false}) {
            const double gap = 0.5 * static_cast<double>(cycles) * speed * dt;
            Scene scene =
                scene_of({.normal = stiffness, .incremental = incremental}, dt, 3.0 * contact_time);
            add_sphere(scene, {-r - 0.5 * gap, 0.0, 0.0}, {0.5 * speed, 0.0, 0.0});
            add_sphere(scene, {r + 0.5 * gap, 0.0, 0.0}, {-0.5 * speed, 0.0, 0.0});
            // Contact objects only of what touches, nearly.
            scene.detection.tolerance = 1e-9;
            scene.detection.trigger = RemapInterval{.cycles = cycles};
            Run run(scene);
            run.advance(0);
            const double before = run.now("kinetic_energy");
            double found = 0.0;
            while (!run.advance(1)) {
                if (found == 0.0 && run.simulation().touching_count() > 0) {
                    found = 2.0 * r - (run.ball(1).position.x - run.ball(0).position.x);
                }
            }
            const double gained = run.now("kinetic_energy") - before;
            const double spring = 0.5 * stiffness * found * found;
            const std::string label = std::string(incremental ? ", incremental" : ", absolute") +
                                      ", a search every " + std::to_string(cycles) + " cycles";
            checks.add("contacts found late" + label,
                       "1",
                       1.0,
                       static_cast<double>(run.simulation().summary().late_contacts),
                       exact());
            if (incremental) {
                checks.add_bound("energy gained over that before" + label,
                                 "1",
                                 1e-3,
                                 std::max(0.0, gained / before),
                                 "starts from no force; half a kick at 400 steps in an impact");
            } else {
                checks.add("energy gained over that before" + label,
                           "1",
                           spring / before,
                           gained / before,
                           {0.01, "half a kick of k d too much in the first step"});
            }
        }
    }
}

void check_cradle(Checks& checks) {
    for (const int fliers : {1, 2, 3, 4}) {
        Scene scene = scene_of({.normal = stiffness}, contact_time / 200.0, 60.0 * contact_time);
        for (int n = 0; n < 5; ++n) {
            const double gap = n < fliers ? 5e-5 : 0.0;
            add_sphere(
                scene, {2.0 * r * n - gap + 5e-5, 0.0, 0.0}, {n < fliers ? 1.0 : 0.0, 0.0, 0.0});
        }
        Run run(scene);
        const Ending ending = watch(run, ~std::uint64_t{0});
        const std::string label = ", " + std::to_string(fliers) + " fliers";
        checks.add_claim("runs to its end" + label, !ending.stopped);
        checks.add("momentum over that of one" + label,
                   "1",
                   fliers,
                   momentum_of(run).x / mass,
                   round_off(1e4, 1.0));
        checks.add("energy over that of one" + label,
                   "1",
                   fliers,
                   run.now("kinetic_energy") / (0.5 * mass),
                   {1e-3, "a few impacts of 200 steps"});
    }
}

/// 64 undamped balls in a box, 100 steps in an impact.
void check_gas(Checks& checks) {
    const double dt = contact_time / 100.0;
    const std::uint64_t cycles = checks.is_full() ? 10'000'000 : 100'000;
    Scene scene = scene_of({.normal = stiffness}, dt, static_cast<double>(cycles) * dt);
    scene.observables.energy = EnergyObservable{};
    add_box(scene, "box", {0.0, 0.0, 0.0}, {0.04, 0.04, 0.04});
    Noise noise(3);
    for (int n = 0; n < 64; ++n) {
        add_sphere(scene,
                   {0.005 + 0.01 * (n % 4), 0.005 + 0.01 * (n / 4 % 4), 0.005 + 0.01 * (n / 16)},
                   noise.vector());
    }
    Run run(scene);
    run.advance(0);
    const double before = mechanical_energy(run);
    const Ending ending = watch(run, cycles, cycles / 100);
    checks.add_claim("runs to its end", !ending.stopped);
    checks.add_bound("largest energy over that at the start, less 1",
                     "1",
                     1e-2,
                     ending.largest / before - 1.0,
                     "errors of impacts, of either sign, at 100 steps");
}

}  // namespace

std::vector<Case> stable_contact_cases() {
    return {{.name = "stability/damping",
             .section = "1.8",
             .title = "damping ratios 0 to 1 in all modes",
             .run = check_damping},
            {.name = "stability/overlap",
             .section = "1.4",
             .title = "initial overlaps from 1 % to coincident centres",
             .run = check_overlaps},
            {.name = "stability/ratios",
             .section = "2.2",
             .title = "size ratio 100, density ratio 1000, stiffness ratio 1e4 in one scene",
             .run = check_ratios},
            {.name = "stability/speed",
             .section = "2.4",
             .title = "impacts at 0.01 to 1e6 radii per step",
             .run = check_speeds},
            {.name = "stability/oblique",
             .section = "1.5",
             .title = "20 angles, 5 friction values, 3 spins",
             .run = check_oblique},
            {.name = "stability/late-contact",
             .section = "1.4",
             .title = "searches every 1 to 100 cycles, both normal springs",
             .run = check_late},
            {.name = "stability/cradle",
             .section = "10.6",
             .title = "Newton's cradle with one to four fliers",
             .run = check_cradle},
            {.name = "stability/gas",
             .section = "10.12",
             .title = "an elastic gas in a box, up to 1e7 steps",
             .run = check_gas}};
}

}  // namespace grainbench::verify
