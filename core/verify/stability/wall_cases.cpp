// Walls that are coarse, sharp, closing or fast.
#include "core/verify/registry.hpp"
#include "core/verify/scenes.hpp"
#include "core/verify/stability/watched.hpp"

#include <algorithm>
#include <array>

namespace grainbench::verify {

namespace {

constexpr double stiffness = 1e5;
constexpr double gravity = 9.8;
const double mass = small_sphere.mass();
const double r = small_sphere.radius;

const Laws resting{.normal = stiffness,
                   .shear = stiffness,
                   .incremental = true,
                   .friction = 0.5,
                   .damping = 0.3,
                   .damping_mode = 3};

/// Lets a ball fall into a place where it comes to rest; checks that it rests and that the walls
/// carry its weight.
void check_rest(Checks& checks, Scene scene, const std::string& label) {
    scene.timestep = automatic_step(0.5);
    Run run(scene);
    const Ending ending = watch(run, ~std::uint64_t{0});
    checks.add_claim("runs to its end" + label, !ending.stopped);
    const Ball ball = run.ball();
    checks.add_bound("speed left over that of a fall by one radius" + label,
                     "1",
                     1e-6,
                     norm(ball.velocity) / std::sqrt(2.0 * gravity * r),
                     "rest");
    const Vec3 weight = -mass * *scene.gravity;
    checks.add_bound("force of the walls less the weight, over the weight" + label,
                     "1",
                     1e-5,
                     norm(ball.force - weight) / norm(weight),
                     "rest");
    checks.add_bound("warnings" + label,
                     "1",
                     0.0,
                     static_cast<double>(run.simulation().summary().warnings.size()),
                     "inside, and not deep");
}

void check_corner(Checks& checks) {
    for (const Vec3& down :
         {Vec3{0.0, 0.0, -1.0}, Vec3{-1.0, -1.0, -1.0}, Vec3{-1.0, -0.2, -3.0}}) {
        Scene scene = scene_of(resting, 1e-5, 1.5);
        scene.gravity = gravity * normalized(down);
        add_box(scene, "box", {0.0, 0.0, 0.0}, {0.03, 0.03, 0.03});
        add_sphere(scene, {0.009, 0.008, 0.01}, {-0.1, -0.1, -0.1});
        if (down.x == 0.0) {
            // Nothing but rolling dissipation would stop it on the level.
            std::get<ListInsertion>(scene.particles.insertion.back()).particles[0].velocity = {};
        }
        check_rest(
            checks,
            scene,
            ", pulled along " + text_of(down.x) + " " + text_of(down.y) + " " + text_of(down.z));
    }
}

void check_wedge(Checks& checks) {
    for (const double degrees : {10.0, 60.0, 120.0, 150.0}) {
        const double half = 0.5 * degrees * pi / 180.0;
        Scene scene = scene_of(resting, 1e-5, 1.5);
        scene.gravity = Vec3{0.0, 0.0, -gravity};
        add_plane(scene, "left", {}, {std::cos(half), 0.0, std::sin(half)});
        add_plane(scene, "right", {}, {-std::cos(half), 0.0, std::sin(half)});
        add_sphere(scene, {0.2 * r, 0.0, r / std::sin(half) + 2.0 * r});
        check_rest(checks, scene, ", wedge of " + text_of(degrees) + " degrees");
    }
}

/// A cone of `count` triangles that opens upwards, tip at the origin.
void add_cone(Scene& scene, int count, double rise) {
    std::vector<Vec3> vertices{{}};
    std::vector<std::vector<std::int64_t>> triangles;
    for (int n = 0; n < count; ++n) {
        const double angle = 2.0 * pi * n / count;
        vertices.push_back({0.05 * std::cos(angle), 0.05 * std::sin(angle), 0.05 * rise});
        triangles.push_back({0, n + 1, (n + 1) % count + 1});
    }
    add_triangles(scene, "cone", std::move(vertices), std::move(triangles));
}

void check_cone(Checks& checks) {
    // Dashpots of many contacts add up: a ratio of 0.05 is one of 0.3 on forty facets.
    Laws laws = resting;
    laws.damping = 0.05;
    for (const int count : {3, 6, 40}) {
        for (const double rise : {0.3, 3.0}) {
            Scene scene = scene_of(laws, 1e-5, 1.0);
            scene.gravity = Vec3{0.0, 0.0, -gravity};
            add_cone(scene, count, rise);
            const double height = r * std::sqrt(1.0 + rise * rise);
            add_sphere(scene, {0.0, 0.0, 2.0 * height + r});
            check_rest(
                checks, scene, ", " + std::to_string(count) + " facets, slope " + text_of(rise));
        }
    }
}

/// An elastic ball that falls on edges and vertices: it must leave with the energy it came with.
void check_features(Checks& checks) {
    struct Drop {
        const char* name;
        Vec3 at;
    };

    double worst = 0.0;
    int drops = 0;
    // A pyramid of four coarse facets, a lone sliver 1 mm by 0.1 um, and its two halves.
    for (const double height : {0.0, 0.002, 0.01}) {
        for (const double dx : {0.0, 1e-9, 1e-5, 1e-3}) {
            for (const double dy : {0.0, 1e-9, 1e-3}) {
                Scene scene = scene_of({.normal = stiffness},
                                       half_period(mass, stiffness) / 200.0,
                                       20.0 * half_period(mass, stiffness));
                add_triangles(scene,
                              "pyramid",
                              {{-0.02, -0.02, 0.0},
                               {0.02, -0.02, 0.0},
                               {0.02, 0.02, 0.0},
                               {-0.02, 0.02, 0.0},
                               {0.0, 0.0, height}},
                              {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
                add_sphere(scene, {dx, dy, height + r + 1e-6}, {0.0, 0.0, -1.0});
                Run run(scene);
                run.finish();
                worst = std::max(worst, std::abs(run.now("kinetic_energy") / (0.5 * mass) - 1.0));
                ++drops;
            }
        }
    }
    checks.add_bound("energy after over that before, less 1, worst of " + std::to_string(drops),
                     "1",
                     2e-3,
                     worst,
                     "200 steps in an impact, on faces, edges and a vertex");
    worst = 0.0;
    for (const double width : {1e-3, 1e-5, 1e-7}) {
        for (const double dx : {0.0, 1e-6, 5e-4}) {
            Scene scene = scene_of({.normal = stiffness},
                                   half_period(mass, stiffness) / 200.0,
                                   2.0 * half_period(mass, stiffness));
            add_triangles(
                scene,
                "slivers",
                {{-0.02, 0.0, 0.0}, {0.02, 0.0, 0.0}, {0.02, width, 0.0}, {-0.02, width, 0.0}},
                {{0, 1, 2}, {0, 2, 3}});
            add_sphere(scene, {dx, 0.5 * width, r + 1e-6}, {0.0, 0.0, -1.0});
            Run run(scene);
            run.finish();
            worst = std::max(worst, std::abs(run.now("kinetic_energy") / (0.5 * mass) - 1.0));
        }
    }
    checks.add_bound("the same on slivers down to 4 cm by 0.1 um",
                     "1",
                     2e-3,
                     worst,
                     "200 steps in an impact: two coplanar facets count once");
}

/// A strip of coplanar facets of very different shapes, crossed by a rolling ball.
void check_seams(Checks& checks) {
    Scene scene = scene_of(resting, 2e-6, 0.12);
    scene.gravity = Vec3{0.0, 0.0, -gravity};
    std::vector<Vec3> vertices;
    std::vector<std::vector<std::int64_t>> triangles;
    const std::array<double, 9> cuts{-0.05, -0.02, -0.0199, -0.019899, 0.0, 1e-7, 0.01, 0.03, 0.06};
    for (const double x : cuts) {
        vertices.push_back({x, -0.02, 0.0});
        vertices.push_back({x, 0.02, 0.0});
    }
    for (std::int64_t n = 0; n + 1 < static_cast<std::int64_t>(cuts.size()); ++n) {
        triangles.push_back({2 * n, 2 * n + 2, 2 * n + 3});
        triangles.push_back({2 * n, 2 * n + 3, 2 * n + 1});
    }
    add_triangles(scene, "floor", std::move(vertices), std::move(triangles));
    const double overlap = mass * gravity / stiffness;
    add_sphere(scene, {-0.03, 0.001, r - overlap}, {0.6, 0.01, 0.0}, {-0.01 / r, 0.6 / r, 0.0});
    Run run(scene);
    double jump = 0.0;
    double speed = 0.0;
    const std::uint64_t settling = 5000;
    run.each_cycle([&] {
        if (run.simulation().cycle() < settling) {
            return;
        }
        const Ball ball = run.ball();
        jump = std::max(jump, std::abs(ball.force.z / (mass * gravity) - 1.0));
        speed = std::max(speed, std::abs(ball.velocity.x - 0.6));
    });
    checks.add_bound("force over the weight, less 1, over seams and slivers",
                     "1",
                     1e-4,
                     jump,
                     "what is left of settling");
    checks.add_bound("change of speed", "m/s", 1e-4, speed, "rolls on");
}

/// Two planes that close on a ball: trouble is named before the ball is forgotten.
void check_closing(Checks& checks) {
    for (const double speed : {0.01, 0.1, 1.0}) {
        Scene scene = scene_of({.normal = stiffness, .damping = 0.3}, 1e-6, 0.01 / speed);
        scene.timestep = automatic_step(0.5);
        add_plane(scene, "left", {}, {1.0, 0.0, 0.0});
        add_plane(scene, "right", {0.01, 0.0, 0.0}, {-1.0, 0.0, 0.0});
        scene.walls.back().motion = ConstantMotion{.velocity = {-speed, 0.0, 0.0}};
        add_sphere(scene, {0.005, 0.0, 0.0});
        const Ending ending = watch(scene);
        checks.add_claim("stopped for its overlap at " + text_of(speed) + " m/s",
                         ending.stopped && ending.what.find("overlaps") != std::string::npos);
    }
}

/// A plane at 100 diameters of the ball per second, and far faster ones.
void check_fast_wall(Checks& checks) {
    for (const double diameters : {1.0, 100.0, 1e3, 1e4}) {
        const double speed = diameters * 2.0 * r;
        const double dt = half_period(mass, stiffness) / 400.0;
        Scene scene = scene_of(
            {.normal = stiffness}, dt, 3.0 * half_period(mass, stiffness) + 1e-3 * r / speed);
        add_plane(scene, "wall", {-1e-3 * r, 0.0, 0.0}, {1.0, 0.0, 0.0});
        scene.walls.back().motion = ConstantMotion{.velocity = {speed, 0.0, 0.0}};
        add_sphere(scene, {r, 0.0, 0.0});
        Run run(scene);
        const Ending ending = watch(run, ~std::uint64_t{0});
        const std::string label = " at " + text_of(diameters) + " diameters/s";
        if (ending.stopped) {
            checks.add_claim("named" + label, diameters > 100.0);
        } else {
            checks.add("speed of the ball over that of the wall" + label,
                       "1",
                       2.0,
                       run.ball().velocity.x / speed,
                       {2e-3, "400 steps in an impact"});
        }
    }
}

void check_shaking(Checks& checks) {
    for (const double loads : {1.0, 50.0, 400.0}) {
        Scene scene = scene_of({.normal = 1e7,
                                .shear = 1e7,
                                .incremental = true,
                                .friction = 0.6,
                                .damping = 0.02,
                                .damping_mode = 3},
                               1e-6,
                               checks.is_full() ? 0.5 : 0.03);
        scene.timestep = automatic_step(0.8);
        scene.gravity = Vec3{0.0, 0.0, -gravity};
        add_box(scene, "box", {0.0, 0.0, 0.0}, {0.03, 0.03, 0.03});
        const double frequency = 100.0;
        scene.walls.back().motion =
            SinusoidMotion{.velocity = {0.0, 0.0, loads * gravity / (2.0 * pi * frequency)},
                           .frequency = frequency};
        Noise noise(5);
        for (int n = 0; n < 27; ++n) {
            add_sphere(
                scene,
                {0.005 + 0.009 * (n % 3), 0.005 + 0.009 * (n / 3 % 3), 0.005 + 0.009 * (n / 9)},
                0.1 * noise.vector());
        }
        Run run(scene);
        const Ending ending = watch(run, ~std::uint64_t{0});
        const std::string label = " at " + text_of(loads) + " g";
        checks.add_claim("runs to its end" + label, !ending.stopped);
        checks.add_bound("warnings" + label,
                         "1",
                         0.0,
                         static_cast<double>(run.simulation().summary().warnings.size()),
                         "none left the box");
    }
}

}  // namespace

std::vector<Case> stable_wall_cases() {
    return {{.name = "stability/corner",
             .section = "5",
             .title = "a ball in a corner",
             .run = check_corner},
            {.name = "stability/wedge",
             .section = "5",
             .title = "a ball in wedges of 10 to 150 degrees",
             .run = check_wedge},
            {.name = "stability/cone",
             .section = "5",
             .title = "a ball in the tip of cones of 3 to 40 facets",
             .run = check_cone},
            {.name = "stability/features",
             .section = "5",
             .title = "on edges, vertices and slivers",
             .run = check_features},
            {.name = "stability/seams",
             .section = "5",
             .title = "rolling over coplanar facets and slivers",
             .run = check_seams},
            {.name = "stability/closing",
             .section = "5",
             .title = "between walls that close",
             .run = check_closing},
            {.name = "stability/fast-wall",
             .section = "6",
             .title = "a wall at 1 to 1e4 diameters per second",
             .run = check_fast_wall},
            {.name = "stability/shaking",
             .section = "6",
             .title = "a box shaken at 1 to 400 g",
             .run = check_shaking}};
}

}  // namespace grainbench::verify
