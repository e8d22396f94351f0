// What rests must stay at rest, and what slides or spins must come to rest.
#include "core/verify/registry.hpp"
#include "core/verify/scenes.hpp"
#include "core/verify/stability/watched.hpp"

#include <algorithm>

namespace grainbench::verify {

namespace {

constexpr double stiffness = 1e5;
constexpr double gravity = 9.8;
const double mass = small_sphere.mass();
const double r = small_sphere.radius;

/// Balls upon each other, each as deep as the weight above it asks.
void check_column(Checks& checks) {
    const int count = checks.is_full() ? 1000 : 100;
    const std::uint64_t cycles = checks.is_full() ? 1'000'000 : 20'000;
    const double dt = 0.5 * std::sqrt(mass / stiffness);
    Scene scene =
        scene_of({.normal = stiffness, .damping = 0.05}, dt, static_cast<double>(cycles) * dt);
    scene.gravity = Vec3{0.0, 0.0, -gravity};
    add_plane(scene, "floor", {}, {0.0, 0.0, 1.0});
    double z = 0.0;
    for (int n = 0; n < count; ++n) {
        const double overlap = (count - n) * mass * gravity / stiffness;
        z += (n == 0 ? r : 2.0 * r) - overlap;
        add_sphere(scene, {0.0, 0.0, z});
    }
    Run run(scene);
    run.advance(0);
    const double top = run.ball(static_cast<std::size_t>(count - 1)).position.z;
    const Ending ending = watch(run, ~std::uint64_t{0});
    checks.add_claim("runs to its end", !ending.stopped);
    double fastest = 0.0;
    for (const Vec3& v : run.simulation().particle_frame().velocity) {
        fastest = std::max(fastest, norm(v));
    }
    checks.add_bound("fastest over a fall by one radius",
                     "1",
                     1e-8,
                     fastest / std::sqrt(2.0 * gravity * r),
                     "round-off of forces: at rest");
    checks.add_bound("the top moved by, in radii",
                     "1",
                     1e-6,
                     (run.ball(static_cast<std::size_t>(count - 1)).position.z - top) / r,
                     "round-off of overlaps");
    checks.add("force of the lowest on the floor over the weight of all",
               "1",
               1.0,
               (stiffness * (r - run.ball(0).position.z)) / (count * mass * gravity),
               {1e-7, "rest, and round-off of an overlap of 1e-8 m and more"});
}

void check_pile(Checks& checks) {
    const double settling = 3.0;
    const double resting = checks.is_full() ? 10.0 : 0.5;
    Scene scene = scene_of({.normal = stiffness,
                            .shear = stiffness,
                            .incremental = true,
                            .friction = 0.8,
                            .damping = 0.3,
                            .damping_mode = 3},
                           1e-5,
                           settling + resting);
    scene.timestep = automatic_step(0.8);
    scene.gravity = Vec3{0.0, 0.0, -gravity};
    add_box(scene, "box", {-0.011, -0.011, 0.0}, {0.011, 0.011, 0.1});
    scene.particles.insertion.emplace_back(LatticeInsertion{.species = "ball",
                                                            .origin = {-0.0064, -0.0064, 0.0035},
                                                            .spacing = {0.0064, 0.0064, 0.0064},
                                                            .counts = {3, 3, 6},
                                                            .velocity = {},
                                                            .jitter = 1.5e-4});
    Run run(scene);
    run.advance(0);
    while (run.simulation().time() < settling) {
        run.advance(10);
    }
    const ParticleFrame before = run.simulation().particle_frame();
    const Ending ending = watch(run, ~std::uint64_t{0});
    checks.add_claim("runs to its end", !ending.stopped);
    const std::vector<Vec3> after = run.simulation().particle_frame().position;
    double height = 0.0;
    int movers = 0;
    for (std::size_t n = 0; n < before.size(); ++n) {
        const Vec3 way = after[n] - before.position[n];
        height += way.z / static_cast<double>(before.size());
        movers += before.contacts[n] >= contacts_that_hold && norm(way) > 1e-3 * r ? 1 : 0;
    }
    checks.add_bound(
        "mean height changed by, in radii", "1", 1e-4, height / r, "neither compacts nor swells");
    const Held held = held_spheres(run.simulation(), mass);
    checks.add_claim("three contacts or more hold nine balls of ten", held.count * 10 >= 54 * 9);
    checks.add("of those, balls that moved by more than 1e-3 radii", "1", 0.0, movers, exact());
    checks.add_bound("their kinetic energy over a fall by one radius",
                     "1",
                     1e-12,
                     held.energy / (54.0 * mass * gravity * r),
                     "round-off of forces: at rest");
}

/// A ball in a groove, thrown and spinning about each axis: sliding in the groove stops it.
void check_spinning(Checks& checks) {
    for (const Vec3& spin : {Vec3{0.0, 0.0, 100.0}, Vec3{50.0, 0.0, 0.0}, Vec3{0.0, 30.0, 30.0}}) {
        Scene scene = scene_of({.normal = stiffness,
                                .shear = stiffness,
                                .friction = 0.4,
                                .damping = 0.2,
                                .damping_mode = 3},
                               1e-5,
                               1.0);
        scene.timestep = automatic_step(0.5);
        scene.gravity = Vec3{0.0, 0.0, -gravity};
        // Three planes: a pit in which every motion slides somewhere.
        for (int n = 0; n < 3; ++n) {
            const double angle = 2.0 * pi * n / 3.0;
            add_plane(
                scene, "side " + std::to_string(n), {}, {std::cos(angle), std::sin(angle), 1.0});
        }
        add_sphere(scene, {0.0, 0.0, std::sqrt(2.0) * r * 1.001}, {}, spin);
        Run run(scene);
        const Ending ending = watch(run, ~std::uint64_t{0});
        const std::string label =
            ", spin " + text_of(spin.x) + " " + text_of(spin.y) + " " + text_of(spin.z);
        checks.add_claim("runs to its end" + label, !ending.stopped);
        checks.add_bound("kinetic energy left over a fall by one radius" + label,
                         "1",
                         1e-9,
                         run.now("kinetic_energy") / (mass * gravity * r),
                         "comes to rest, with friction springs that hold");
    }
}

}  // namespace

std::vector<Case> stable_rest_cases() {
    return {{.name = "stability/column",
             .section = "10.13",
             .title = "balls upon each other at rest, up to 1000 for 1e6 steps",
             .run = check_column},
            {.name = "stability/pile",
             .section = "1.5",
             .title = "a pile at rest neither creeps nor ratchets",
             .run = check_pile},
            {.name = "stability/spinning",
             .section = "1.5",
             .title = "spinning to rest in a pit",
             .run = check_spinning}};
}

}  // namespace grainbench::verify
