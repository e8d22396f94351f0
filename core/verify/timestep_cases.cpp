#include "core/verify/registry.hpp"
#include "core/verify/run.hpp"
#include "core/verify/scenes.hpp"

#include <algorithm>

namespace grainbench::verify {

namespace {

const double mass = small_sphere.mass();
const double touch = 1e-9;  ///< [m] overlap of contacts that shall just exist

Laws laws_with(double beta, double shear = 1e5) {
    Laws laws{.normal = 1e5, .shear = shear, .friction = 0.6};
    if (beta > 0.0) {
        laws.damping = beta;
        laws.damping_mode = 3;
    }
    return laws;
}

/// Ball at the origin's height on a floor, and under a ceiling if asked.
Scene resting_scene(const Laws& laws, const AutomaticTimestep& timestep, bool ceiling) {
    Scene scene = scene_of(laws, 1.0, 1.0);
    scene.timestep = timestep;
    const double reach = small_sphere.radius - touch;
    add_plane(scene, "floor", {0.0, 0.0, -reach}, {0.0, 0.0, 1.0});
    if (ceiling) {
        add_plane(scene, "ceiling", {0.0, 0.0, reach}, {0.0, 0.0, -1.0});
    }
    add_sphere(scene, {});
    return scene;
}

double first_step(const Scene& scene) {
    Run run(scene);
    run.advance(1);
    return run.simulation().timestep();
}

/// Contact stiffness as the stable step counts it (physics reference 2.2).
double corrected(double stiffness, double beta) {
    const double factor = std::sqrt(1.0 + beta * beta) - beta;
    return stiffness / (factor * factor);
}

void check_contacts(Checks& checks) {
    struct Row {
        const char* label;
        double beta, shear;
        bool ceiling;
        double stiffness_over_mass, printed;
    };

    const double k = corrected(1e5, 0.02);
    for (const Row& row :
         {Row{"one contact", 0.02, 1e5, false, k / (0.4 * mass), 2.0427e-5},
          Row{"one contact without shear", 0.02, 0.0, false, k / mass, 3.2298e-5},
          Row{"two contacts", 0.02, 1e5, true, 2.0 * k / (0.4 * mass), 1.4444e-5},
          Row{"one contact, beta 0", 0.0, 1e5, false, 1e5 / (0.4 * mass), 2.0840e-5}}) {
        const double got =
            first_step(resting_scene(laws_with(row.beta, row.shear), {}, row.ceiling));
        const double expected = 0.8 / std::sqrt(row.stiffness_over_mass);
        checks.add(std::string("dt, ") + row.label, "s", expected, got, round_off(20.0, expected));
        checks.add(std::string("dt in the reference, ") + row.label,
                   "s",
                   row.printed,
                   got,
                   {5.1e-10, "half of the last printed digit"});
    }
    // Six contacts, one on each face of a box: the isotropic sum of physics reference 2.3.
    Scene scene = resting_scene(laws_with(0.02), {}, false);
    const double reach = small_sphere.radius - touch;
    scene.walls.front().shape =
        BoxShape{.low = {-reach, -reach, -reach}, .high = {reach, reach, reach}};
    const double expected = 0.8 * std::sqrt(0.1 * mass / k);
    checks.add("dt, six contacts", "s", expected, first_step(scene), round_off(20.0, expected));
}

/// The steps that the example prints: translation, four contacts along one axis. Four floors in one
/// place make four such contacts.
void check_four_contacts(Checks& checks) {
    struct Row {
        const char* label;
        Sphere sphere;
        double stiffness, safety, printed, digit;
    };

    for (const Row& row : {Row{"intruder, k 4.712e8", intruder, 4.712e8, 0.8, 8.764e-7, 5e-11},
                           Row{"k 1e7", small_sphere, 1e7, 1.0, 2.06e-6, 5e-9},
                           Row{"k 1e6", small_sphere, 1e6, 1.0, 6.51e-6, 5e-9},
                           Row{"k 1e5", small_sphere, 1e5, 1.0, 2.06e-5, 5e-8},
                           Row{"k 1e4", small_sphere, 1e4, 1.0, 6.51e-5, 5e-8},
                           Row{"k 1e3", small_sphere, 1e3, 1.0, 2.06e-4, 5e-7}}) {
        Scene scene = scene_of({.normal = row.stiffness}, 1.0, 1.0, row.sphere);
        scene.timestep = automatic_step(row.safety);
        for (const char* name : {"first", "second", "third", "fourth"}) {
            add_plane(scene, name, {}, {0.0, 0.0, 1.0});
        }
        add_sphere(scene, {0.0, 0.0, row.sphere.radius - touch});
        checks.add(std::string("dt, ") + row.label,
                   "s",
                   row.printed,
                   first_step(scene),
                   {row.digit, "half of the last printed digit"});
    }
}

/// The ceiling leaves at once: the step may grow by 1.05 a cycle, up to that of the floor alone.
void check_growth(Checks& checks) {
    Scene scene = resting_scene(laws_with(0.02), {}, true);
    scene.walls.back().motion = ConstantMotion{.velocity = {0.0, 0.0, 10.0}};
    scene.stages.front().duration = 1e-3;
    Run run(scene);
    double before = 0.0;
    double growth = 0.0;
    double growing = 0.0;
    run.each_cycle([&] {
        const double dt = run.simulation().timestep();
        if (before > 0.0 && dt > before) {
            growth = std::max(growth, dt / before);
            growing += 1.0;
        }
        before = dt;
    });
    checks.add("largest growth from cycle to cycle", "1", 1.05, growth, round_off(4.0, 1.0));
    // ln sqrt 2 / ln 1.05 = 7.1
    checks.add("cycles of growth", "1", 8.0, growing, exact());
    checks.add("dt in the end", "s", 2.0427e-5, before, {5e-10, "half of the last printed digit"});
}

void check_bounds(Checks& checks) {
    const double whole = first_step(resting_scene(laws_with(0.02), automatic_step(1.0), false));
    for (const double safety : {0.1, 0.5, 0.8, 2.0}) {
        const std::string label = "dt at safety factor " + text_of(safety) + " over dt at 1";
        const double got =
            first_step(resting_scene(laws_with(0.02), automatic_step(safety), false)) / whole;
        checks.add(label, "1", safety, got, round_off(2.0, safety));
    }
    checks.add("dt where the maximum is 1e-5 s",
               "s",
               1e-5,
               first_step(resting_scene(laws_with(0.02), {.maximum = 1e-5}, false)),
               exact());
    // No particle may cross its tolerance, r/16, in one step.
    Scene fast = scene_of({.normal = 100.0}, 1.0, 1.0);
    fast.timestep = AutomaticTimestep{};
    add_sphere(fast, {}, {1.0, 0.0, 0.0});
    checks.add("dt of a ball at 1 m/s", "s", 1.875e-4, first_step(fast), round_off(4.0, 1.875e-4));
}

}  // namespace

std::vector<Case> timestep_cases() {
    return {
        {.name = "timestep/contacts",
         .section = "10.10",
         .title = "automatic step of one, two and six contacts",
         .run = check_contacts},
        {.name = "timestep/four-contacts",
         .section = "2.3",
         .title = "the example's steps: four contacts along an axis",
         .run = check_four_contacts},
        {.name = "timestep/growth",
         .section = "10.10",
         .title = "growth of the step when a contact ends",
         .run = check_growth},
        {.name = "timestep/bounds",
         .section = "2.4",
         .title = "safety factor, maximum and kinematic limit",
         .run = check_bounds},
    };
}

}  // namespace grainbench::verify
