#include "core/verify/registry.hpp"
#include "core/verify/run.hpp"
#include "core/verify/scenes.hpp"

#include <algorithm>
#include <array>

namespace grainbench::verify {

namespace {

constexpr double gravity = 9.8;
constexpr double stiffness = 1e5;
const double r = small_sphere.radius;

/// Floor z = 0 of triangles, 12 by 6 cells of 10 mm, whose diagonals alternate.
Triangles tiled_floor() {
    Triangles floor;
    constexpr std::int64_t along = 12;
    constexpr std::int64_t across = 6;
    for (std::int64_t j = 0; j <= across; ++j) {
        for (std::int64_t i = 0; i <= along; ++i) {
            floor.vertices.push_back(
                {0.01 * static_cast<double>(i) - 0.06, 0.01 * static_cast<double>(j) - 0.03, 0.0});
        }
    }
    for (std::int64_t j = 0; j < across; ++j) {
        for (std::int64_t i = 0; i < along; ++i) {
            const std::int64_t a = j * (along + 1) + i;
            const std::int64_t b = a + along + 1;
            if ((i + j) % 2 == 0) {
                floor.triangles.push_back({a, a + 1, b + 1});
                floor.triangles.push_back({a, b + 1, b});
            } else {
                floor.triangles.push_back({a, a + 1, b});
                floor.triangles.push_back({a + 1, b + 1, b});
            }
        }
    }
    return floor;
}

/// Rolls from one end to the other, aslant, across edges and corners, with history in both springs.
Scene rolling_scene(const WallShape& floor) {
    Scene scene = scene_of({.normal = stiffness,
                            .shear = stiffness,
                            .incremental = true,
                            .friction = 0.6,
                            .damping = 0.02,
                            .damping_mode = 3},
                           2e-6,
                           0.2);
    scene.gravity = Vec3{0.0, 0.0, -gravity};
    Wall wall;
    wall.name = "floor";
    wall.shape = floor;
    scene.walls.push_back(std::move(wall));
    const Vec3 velocity{0.5, 0.03, 0.0};
    add_sphere(scene, {-0.05, -0.004, r}, velocity, {-velocity.y / r, velocity.x / r, 0.0});
    return scene;
}

/// Lets the ball settle into its overlap first.
constexpr std::uint64_t settling = 20000;

void check_rolling(Checks& checks) {
    Run tiled(rolling_scene(tiled_floor()));
    Run plane(rolling_scene(Plane{}));
    const double weight = small_sphere.mass() * gravity;
    tiled.advance(settling);
    plane.advance(settling);
    double before = tiled.ball().force.z;
    double jump = 0.0;
    double apart = 0.0;
    double spin_apart = 0.0;
    tiled.each_cycle([&] {
        plane.advance(1);
        const Ball ball = tiled.ball();
        const Ball other = plane.ball();
        jump = std::max(jump, std::abs(ball.force.z - before));
        before = ball.force.z;
        apart = std::max(apart, norm(ball.velocity - other.velocity));
        spin_apart = std::max(spin_apart, norm(ball.spin - other.spin));
    });
    checks.add("way",
               "m",
               0.5 * 0.2,
               tiled.ball().position.x + 0.05,
               {1e-4, "first settling of the shear spring"});
    checks.add("largest jump of the support over the weight",
               "1",
               0.0,
               jump / weight,
               {1e-6, "edges inside a flat surface carry no force of their own"});
    checks.add("largest difference of velocity from the plane's",
               "m/s",
               0.0,
               apart,
               {1e-6 * 0.5, "a millionth of the speed"});
    checks.add("largest difference of R times spin from the plane's",
               "m/s",
               0.0,
               r * spin_apart,
               {1e-6 * 0.5, "a millionth of the speed"});
}

/// The six faces of a box, two triangles each.
Triangles box_mesh(const Vec3& low, const Vec3& high) {
    Triangles mesh;
    for (int corner = 0; corner < 8; ++corner) {
        mesh.vertices.push_back({(corner & 1) != 0 ? high.x : low.x,
                                 (corner & 2) != 0 ? high.y : low.y,
                                 (corner & 4) != 0 ? high.z : low.z});
    }
    constexpr std::array<std::array<std::int64_t, 4>, 6> faces{
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    for (const auto& face : faces) {
        mesh.triangles.push_back({face[0], face[1], face[2]});
        mesh.triangles.push_back({face[0], face[2], face[3]});
    }
    return mesh;
}

Scene boxed_scene(const WallShape& shape) {
    Scene scene = scene_of({.normal = stiffness,
                            .shear = stiffness,
                            .friction = 0.3,
                            .damping = 0.02,
                            .damping_mode = 3},
                           2e-6,
                           0.05);
    Wall wall;
    wall.name = "box";
    wall.shape = shape;
    scene.walls.push_back(std::move(wall));
    add_sphere(scene, {0.001, -0.002, 0.003}, {0.9, -0.7, 1.1});
    return scene;
}

void check_box(Checks& checks) {
    const Vec3 low{-0.01, -0.01, -0.01};
    const Vec3 high{0.01, 0.01, 0.01};
    Run analytic(boxed_scene(BoxShape{.low = low, .high = high}));
    Run mesh(boxed_scene(box_mesh(low, high)));
    analytic.finish();
    mesh.finish();
    const Ball a = analytic.ball();
    const Ball b = mesh.ball();
    const Tolerance tolerance{1e-12, "round-off, amplified by a few impacts"};
    checks.add("speed", "m/s", norm(a.velocity), norm(b.velocity), tolerance);
    checks.add("difference of velocity", "m/s", 0.0, norm(a.velocity - b.velocity), tolerance);
    checks.add("difference of R times spin", "m/s", 0.0, r * norm(a.spin - b.spin), tolerance);
    checks.add("difference of position", "m", 0.0, norm(a.position - b.position), tolerance);
}

}  // namespace

std::vector<Case> surface_cases() {
    return {
        {.name = "surface/rolling-over-triangles",
         .section = "5.3",
         .title = "a ball rolls over a triangulated plane as over a plane",
         .run = check_rolling},
        {.name = "surface/box-of-triangles",
         .section = "5.3",
         .title = "a ball in a box and in its mesh",
         .run = check_box},
    };
}

}  // namespace grainbench::verify
