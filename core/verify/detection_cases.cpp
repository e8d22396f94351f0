#include "core/verify/registry.hpp"
#include "core/verify/run.hpp"
#include "core/verify/scenes.hpp"

#include <algorithm>
#include <optional>

namespace grainbench::verify {

namespace {

constexpr double stiffness = 1e5;
const double r = small_sphere.radius;

/// Sum of both tolerances of a pair of small spheres [m].
constexpr double pair_tolerance = 0.375e-3;

/// Two balls along x that close at `speed` from a gap between their surfaces.
Scene closing_pair(const Laws& laws, double gap, double speed, double dt, double duration) {
    Scene scene = scene_of(laws, dt, duration);
    add_sphere(scene, {-r - 0.5 * gap, 0.0, 0.0}, {0.5 * speed, 0.0, 0.0});
    add_sphere(scene, {r + 0.5 * gap, 0.0, 0.0}, {-0.5 * speed, 0.0, 0.0});
    return scene;
}

double gap_of(const Run& run) {
    return norm(run.ball(1).position - run.ball(0).position) - 2.0 * r;
}

void check_creation(Checks& checks) {
    const double speed = 1.0;
    const double dt = 1e-6;
    for (const bool every_cycle : {false, true}) {
        Scene scene = closing_pair({.normal = stiffness}, 1.0005e-3, speed, dt, 1.05e-3 / speed);
        if (every_cycle) {
            scene.detection.trigger = RemapInterval{.cycles = 1};
        }
        Run run(scene);
        std::optional<double> created;
        std::optional<double> touched;
        run.each_cycle([&] {
            if (!created && run.simulation().contact_count() > 0) {
                created = gap_of(run);
            }
            if (!touched && run.simulation().touching_count() > 0) {
                touched = gap_of(run);
            }
        });
        if (every_cycle) {
            checks.add("gap at creation, looked for in every cycle",
                       "m",
                       pair_tolerance,
                       created.value_or(-1.0),
                       {speed * dt, "way of one step"});
        } else {
            checks.add("gap at creation, displacement trigger",
                       "m",
                       0.5 * pair_tolerance,
                       created.value_or(-1.0),
                       {0.5 * pair_tolerance, "anywhere between the tolerances and the touch"});
        }
        checks.add(every_cycle ? "gap at the first touch, looked for in every cycle"
                               : "gap at the first touch, displacement trigger",
                   "m",
                   -0.5 * speed * dt,
                   touched.value_or(1.0),
                   {0.5 * speed * dt, "within the first step that ends in overlap"});
    }
}

struct LateImpact {
    double depth = 0.0;   ///< [m] overlap in which the contact was found
    double gained = 0.0;  ///< [J]
    std::uint64_t late = 0;
};

/// A search every 100000 cycles of 1e-8 s: at 5 m/s more than 5 mm of way between two.
LateImpact late_impact(bool incremental, bool wall) {
    const double speed = 5.0;
    const double dt = 1e-8;
    const std::int64_t interval = 100000;
    const double depth = 2e-5;
    const double way = speed * dt * static_cast<double>(interval);
    const Laws laws{.normal = stiffness, .incremental = incremental};
    const double duration = 1.2 * dt * static_cast<double>(interval);
    Scene scene;
    if (wall) {
        scene = scene_of(laws, dt, duration);
        add_plane(scene, "floor", {}, {1.0, 0.0, 0.0});
        add_sphere(scene, {r + way - depth, 0.0, 0.0}, {-speed, 0.0, 0.0});
    } else {
        scene = closing_pair(laws, way - depth, speed, dt, duration);
    }
    scene.detection.trigger = RemapInterval{.cycles = interval};
    scene.observables.energy = EnergyObservable{};
    Run run(scene);
    run.advance(0);
    const double before = run.now("kinetic_energy");
    run.advance(static_cast<std::uint64_t>(interval));
    const double found = wall ? r - run.ball().position.x : -gap_of(run);
    run.finish();
    return {.depth = found,
            .gained = run.now("kinetic_energy") - before,
            .late = run.simulation().summary().late_contacts};
}

void check_late(Checks& checks) {
    for (const bool wall : {false, true}) {
        const std::string with = wall ? ", on a plane" : ", ball on ball";
        const LateImpact absolute = late_impact(false, wall);
        const double spring = 0.5 * stiffness * absolute.depth * absolute.depth;
        checks.add(
            "overlap when found" + with, "m", 2e-5, absolute.depth, {1e-12, "round-off of way"});
        checks.add(
            "contacts found late" + with, "1", 1.0, static_cast<double>(absolute.late), exact());
        checks.add("energy gained, absolute spring" + with,
                   "J",
                   spring,
                   absolute.gained,
                   relative(1e-2, spring, "half a kick of k d0 too much, of order v dt / d0"));
        const LateImpact gentle = late_impact(true, wall);
        checks.add(
            "energy gained, incremental spring" + with,
            "J",
            0.0,
            gentle.gained,
            {1e-2 * spring, "none but the scheme's own; a hundredth of the absolute's gain"});
    }
}

/// Five balls in a row between walls, each passing its speed on many times.
Scene rally(const Detection& detection) {
    Scene scene = scene_of({.normal = stiffness,
                            .shear = stiffness,
                            .friction = 0.3,
                            .damping = 0.02,
                            .damping_mode = 3},
                           2e-6,
                           0.05);
    scene.detection = detection;
    const double half = 0.02;
    add_plane(scene, "left", {-half, 0.0, 0.0}, {1.0, 0.0, 0.0});
    add_plane(scene, "right", {half, 0.0, 0.0}, {-1.0, 0.0, 0.0});
    for (int n = 0; n < 5; ++n) {
        const double x = 0.0065 * (n - 2);
        add_sphere(scene, {x, 1e-4 * n * n, 0.0}, {n == 0 ? 2.0 : 0.1 * n, 0.0, 0.05 * n});
    }
    return scene;
}

void check_triggers(Checks& checks) {
    Run by_way(rally({}));
    Run by_cycles(rally({.trigger = RemapInterval{.cycles = 10}}));
    Run on_overlap(rally({.trigger = DisplacementTrigger{}, .create_on_overlap = true}));
    by_way.finish();
    by_cycles.finish();
    on_overlap.finish();
    for (const auto& [name, other] : {std::pair<const char*, const Run*>{"interval 10", &by_cycles},
                                      {"create on overlap", &on_overlap}}) {
        double apart = 0.0;
        double spin_apart = 0.0;
        for (std::size_t n = 0; n < 5; ++n) {
            apart = std::max(apart, norm(by_way.ball(n).position - other->ball(n).position));
            spin_apart = std::max(spin_apart, norm(by_way.ball(n).spin - other->ball(n).spin));
        }
        checks.add(std::string("distance from the displacement trigger's positions, ") + name,
                   "m",
                   0.0,
                   apart,
                   exact());
        checks.add(
            std::string("difference from its spins, ") + name, "rad/s", 0.0, spin_apart, exact());
        checks.add(std::string("contacts found late, ") + name,
                   "1",
                   0.0,
                   static_cast<double>(other->simulation().summary().late_contacts),
                   exact());
    }
}

}  // namespace

std::vector<Case> detection_cases() {
    return {
        {.name = "detection/creation",
         .section = "10.11",
         .title = "contacts exist before surfaces touch",
         .run = check_creation},
        {.name = "detection/late",
         .section = "10.11",
         .title = "contacts found late, absolute and incremental spring",
         .run = check_late},
        {.name = "detection/triggers",
         .section = "10.11",
         .title = "the same bits however contacts are looked for",
         .run = check_triggers},
    };
}

}  // namespace grainbench::verify
