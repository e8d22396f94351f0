#include "core/verify/registry.hpp"
#include "core/verify/run.hpp"
#include "core/verify/scenes.hpp"

#include <array>

namespace grainbench::verify {

namespace {

constexpr std::size_t column_balls = 10;
constexpr double column_stiffness = 1e5;
constexpr double column_gravity = 9.8;

/// Ball 1 is at the bottom; all just touch at the start.
Scene column_scene(const Timestep& timestep, double duration) {
    Scene scene =
        scene_of({.normal = column_stiffness, .damping = 0.5, .damping_mode = 3}, 1e-5, duration);
    scene.timestep = timestep;
    scene.gravity = Vec3{0.0, 0.0, -column_gravity};
    add_plane(scene, "floor", {}, {0.0, 0.0, 1.0});
    for (std::size_t n = 0; n < column_balls; ++n) {
        add_sphere(scene, {0.0, 0.0, (2.0 * static_cast<double>(n) + 1.0) * small_sphere.radius});
    }
    scene.observables.wall_forces = WallForceObservable{};
    scene.output.contacts = true;
    return scene;
}

void check_column(Checks& checks, const Timestep& timestep, double step, double duration) {
    Run run(column_scene(timestep, duration));
    run.finish();
    checks.add("step", "s", step, run.simulation().timestep(), exact());
    const double weight = small_sphere.mass() * column_gravity;
    const ContactFrame contacts = run.simulation().contact_frame();
    // By the number of balls a contact carries.
    std::vector<double> forces(column_balls + 1);
    for (std::size_t c = 0; c < contacts.i_id.size(); ++c) {
        const auto lower = std::min(contacts.i_id[c], contacts.j_id[c]);
        forces.at(column_balls - static_cast<std::size_t>(lower)) = contacts.force_normal[c];
    }
    // A ball's place, up to 0.06 m, is rounded to 7e-18 m, its overlaps to 1e-17 m.
    const std::string reason = "round-off of positions times stiffness, and the last of the motion";
    for (std::size_t carried = 1; carried <= column_balls; ++carried) {
        const double expected = static_cast<double>(carried) * weight;
        checks.add("force under " + std::to_string(carried) + " balls",
                   "N",
                   expected,
                   forces[carried],
                   relative(1e-9, weight, reason));
    }
    checks.add("force on the floor",
               "N",
               -static_cast<double>(column_balls) * weight,
               run.now("floor.force_z"),
               relative(1e-9, weight, reason));
    const double n = static_cast<double>(column_balls);
    checks.add("bottom force in the reference",
               "N",
               1.66253e-2,
               forces[column_balls],
               {5e-8, "half of the last printed digit"});
    const double compression = 0.5 * weight * n * (n + 1.0) / column_stiffness;
    const double top = run.ball(column_balls - 1).position.z;
    const double got = (2.0 * n - 1.0) * small_sphere.radius - top;
    checks.add("compression", "m", compression, got, relative(1e-9, compression, reason));
    checks.add("compression in the reference",
               "m",
               9.1439e-7,
               got,
               {5e-12, "half of the last printed digit"});
}

/// Of physics reference 10.6 (an established test case of two spheres between walls).
struct Squeezed {
    double lower_density, upper_density;  ///< [kg/m^3]
    double omega_1, omega_2;              ///< [rad/s] in the reference
    double y_1, y_2;                      ///< static heights over r in the reference
};

constexpr double squeezed_radius = 5e-4;
constexpr double squeezed_stiffness = 1e3;
constexpr double squeezed_gravity = 9.81;
constexpr double squeezed_gap = 3.6 * squeezed_radius;

Scene squeezed_scene(const Squeezed& data, double z_1, double z_2, double dt, double duration) {
    Scene scene = scene_of({.normal = squeezed_stiffness},
                           dt,
                           duration,
                           {.radius = squeezed_radius, .density = data.lower_density});
    add_species(scene, "upper", {.radius = squeezed_radius, .density = data.upper_density});
    scene.gravity = Vec3{0.0, 0.0, -squeezed_gravity};
    add_plane(scene, "floor", {}, {0.0, 0.0, 1.0});
    add_plane(scene, "ceiling", {0.0, 0.0, squeezed_gap}, {0.0, 0.0, -1.0});
    add_sphere(scene, {0.0, 0.0, z_1});
    add_sphere(scene, {0.0, 0.0, z_2}, {}, {}, "upper");
    scene.observables.energy = EnergyObservable{};
    return scene;
}

double squeezed_mass(double density) {
    return Sphere{.radius = squeezed_radius, .density = density}.mass();
}

/// Static heights, from three equal springs in a row under two weights.
std::pair<double, double> static_heights(const Squeezed& data) {
    const double r = squeezed_radius;
    const double a = squeezed_mass(data.lower_density) * squeezed_gravity / squeezed_stiffness;
    const double b = squeezed_mass(data.upper_density) * squeezed_gravity / squeezed_stiffness;
    const double squeeze = (4.0 * r - squeezed_gap) / 3.0;
    return {r - squeeze - (2.0 * a + b) / 3.0, squeezed_gap - r + squeeze - (a + 2.0 * b) / 3.0};
}

/// Roots of det([2k/m1, -k/m1; -k/m2, 2k/m2] - omega^2), the lower one first, and z_2/z_1 of each.
struct Mode {
    double omega, ratio;
};

std::array<Mode, 2> modes_of(const Squeezed& data) {
    const double a = squeezed_stiffness / squeezed_mass(data.lower_density);
    const double b = squeezed_stiffness / squeezed_mass(data.upper_density);
    const double root = std::sqrt((a + b) * (a + b) - 3.0 * a * b);
    const double low = a + b - root;
    const double high = a + b + root;
    return {{{std::sqrt(low), 2.0 - low / a}, {std::sqrt(high), 2.0 - high / a}}};
}

/// Angular frequency of z_1 about `rest`, from the upward zero crossings of the whole run.
double measured_omega(Run& run, double rest) {
    double before = 0.0;
    double first = 0.0;
    double last = 0.0;
    double crossings = 0.0;
    run.each_cycle([&] {
        const double now = run.ball(0).position.z - rest;
        if (before < 0.0 && now >= 0.0) {
            last = run.simulation().time() - run.simulation().timestep() * now / (now - before);
            first = crossings == 0.0 ? last : first;
            crossings += 1.0;
        }
        before = now;
    });
    return 2.0 * pi * (crossings - 1.0) / (last - first);
}

void check_squeezed(Checks& checks, const Squeezed& data) {
    const auto [rest_1, rest_2] = static_heights(data);
    const std::array<Mode, 2> modes = modes_of(data);
    const double printed[2] = {data.omega_1, data.omega_2};
    const std::string number[2] = {"first", "second"};
    for (std::size_t m = 0; m < 2; ++m) {
        const double period = 2.0 * pi / modes[m].omega;
        const double dt = period / 500.0;
        const double amplitude = 1e-2 * squeezed_radius;
        Run run(squeezed_scene(
            data, rest_1 + amplitude, rest_2 + modes[m].ratio * amplitude, dt, 20.5 * period));
        const double got = measured_omega(run, rest_1);
        // The leapfrog runs fast by (omega dt)^2 / 24; no damping is on.
        const double scheme = 2.0 / dt * std::asin(0.5 * modes[m].omega * dt);
        checks.add("omega of the " + number[m] + " mode",
                   "rad/s",
                   scheme,
                   got,
                   relative(1e-6, scheme, "crossings by straight lines, 500 steps in a period"));
        checks.add("omega of the " + number[m] + " mode in the reference",
                   "rad/s",
                   printed[m],
                   got,
                   relative(1.5e-5, printed[m], "(omega dt)^2 / 24 = 7e-6, and printed digits"));
    }
    Run still(squeezed_scene(data, rest_1, rest_2, 1e-6, 1e-3));
    still.finish();
    const double r = squeezed_radius;
    checks.add("y_1 / r at rest",
               "1",
               data.y_1,
               still.ball(0).position.z / r,
               {1e-6, "the last printed digit"});
    checks.add("y_2 / r at rest",
               "1",
               data.y_2,
               still.ball(1).position.z / r,
               {1e-6, "the last printed digit"});
}

/// From the start of the original case, a quarter and three quarters of the gap.
void check_squeezed_energy(Checks& checks, const Squeezed& data) {
    const double period = 2.0 * pi / modes_of(data)[1].omega;
    Run run(squeezed_scene(
        data, 0.25 * squeezed_gap, 0.75 * squeezed_gap, period / 1000.0, 50.0 * period));
    run.advance(0);
    const double held = run.now("energy_elastic");
    // Overlaps 0.1 r, 0.2 r, 0.1 r.
    const double r = squeezed_radius;
    const double expected = 0.5 * squeezed_stiffness * 0.06 * r * r;
    checks.add("elastic energy at the start", "J", expected, held, round_off(1000.0, expected));
    double worst = 0.0;
    run.each_cycle([&] { worst = std::max(worst, std::abs(run.now("energy_numerical"))); });
    checks.add("energy made or lost, over the start's",
               "1",
               0.0,
               worst / held,
               {1e-5, "(omega dt)^2 / 4, 1000 steps in the shortest period"});
}

constexpr Squeezed unequal{20000.0, 10000.0, 11003.6, 21257.4, 0.866495, 2.733196};
constexpr Squeezed equal{2000.0, 2000.0, 30901.9, 53523.7, 0.866646, 2.733313};

}  // namespace

std::vector<Case> column_cases() {
    return {
        {.name = "column/static",
         .section = "10.6",
         .title = "ten balls on each other",
         .run =
             [](Checks& checks) { check_column(checks, FixedTimestep{.value = 1e-5}, 1e-5, 0.4); }},
        {.name = "column/scaled-step",
         .section = "2.5",
         .title = "the same forces where inertia is scaled to a step of 1 s",
         .run =
             [](Checks& checks) {
                 check_column(checks, ScaledTimestep{.value = 1.0}, 1.0, 40000.0);
             }},
        {.name = "column/squeezed-unequal",
         .section = "10.6",
         .title = "two unequal spheres between walls",
         .run = [](Checks& checks) { check_squeezed(checks, unequal); }},
        {.name = "column/squeezed-equal",
         .section = "10.6",
         .title = "two equal spheres between walls",
         .run = [](Checks& checks) { check_squeezed(checks, equal); }},
        {.name = "column/squeezed-energy",
         .section = "10.6",
         .title = "two spheres between walls keep their energy",
         .run = [](Checks& checks) { check_squeezed_energy(checks, unequal); }},
    };
}

}  // namespace grainbench::verify
