// The same scene elsewhere, turned, mirrored and in other units; and scenes of next to nothing.
#include "core/verify/registry.hpp"
#include "core/verify/scenes.hpp"
#include "core/verify/stability/watched.hpp"

#include <algorithm>
#include <functional>
#include <limits>

namespace grainbench::verify {

namespace {

const double r = small_sphere.radius;

/// Units of a scene in SI ones.
struct Units {
    double length = 1.0;  ///< [m]
    double mass = 1.0;    ///< [kg]
    double time = 1.0;    ///< [s]
};

using Turn = std::function<Vec3(const Vec3&)>;

/// 27 balls that fall and collide between six planes, with every law on.
Scene tumble(const Units& u, const Turn& turn, const Turn& turn_axial, const Vec3& shift) {
    const double length = 1.0 / u.length;
    const double speed = u.time / u.length;
    const double spring = u.time * u.time / u.mass;
    const Sphere sphere{.radius = r * length,
                        .density = 1500.0 / u.mass * u.length * u.length * u.length};
    Scene scene = scene_of({.normal = 1e4 * spring,
                            .shear = 0.8 * 1e4 * spring,
                            .incremental = true,
                            .friction = 0.4,
                            .damping = 0.1,
                            .damping_mode = 3},
                           4e-6 / u.time,
                           0.02 / u.time,
                           sphere);
    const double acceleration = u.time * u.time / u.length;
    scene.gravity = turn(Vec3{0.0, 1.0 * acceleration, -9.8 * acceleration});
    const auto at = [&](const Vec3& p) { return turn(length * p) + shift; };
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            Vec3 normal{};
            (axis == 0 ? normal.x : axis == 1 ? normal.y : normal.z) = -side;
            add_plane(scene,
                      "plane " + std::to_string(axis) + (side < 0.0 ? " low" : " high"),
                      at(-0.0116 * normal),
                      turn(normal));
        }
    }
    Noise noise(11);
    for (int n = 0; n < 27; ++n) {
        const Vec3 place{0.007 * (n % 3 - 1), 0.007 * (n / 3 % 3 - 1), 0.007 * (n / 9 - 1)};
        const Vec3 velocity = 0.5 * speed * noise.vector();
        const Vec3 spin = 50.0 * u.time * noise.vector();
        add_sphere(scene, at(place), turn(velocity), turn_axial(spin));
    }
    return scene;
}

/// Largest distance of a ball from where it is in the scene as it stands, over the radius.
double apart(const Units& u, const Turn& turn, const Turn& turn_axial, const Vec3& shift) {
    const Turn same = [](const Vec3& v) { return v; };
    Run base(tumble({}, same, same, {}));
    Run other(tumble(u, turn, turn_axial, shift));
    base.finish();
    other.finish();
    const ParticleFrame a = base.simulation().particle_frame();
    const ParticleFrame b = other.simulation().particle_frame();
    double most = 0.0;
    for (std::size_t n = 0; n < a.size(); ++n) {
        most = std::max(most, norm(turn(a.position[n]) - u.length * (b.position[n] - shift)));
    }
    return most / r;
}

void check_frames(Checks& checks) {
    const Turn same = [](const Vec3& v) { return v; };
    const Turn mirror = [](const Vec3& v) { return Vec3{-v.x, v.y, v.z}; };
    const Turn mirror_axial = [](const Vec3& v) { return Vec3{v.x, -v.y, -v.z}; };
    const Turn quarter = [](const Vec3& v) { return Vec3{-v.y, v.x, v.z}; };
    const Turn aslant = [](const Vec3& v) {
        // By 2 pi / 3 about (1, 1, 1), then by 0.3 about z.
        const Vec3 p{v.z, v.x, v.y};
        return Vec3{std::cos(0.3) * p.x - std::sin(0.3) * p.y,
                    std::sin(0.3) * p.x + std::cos(0.3) * p.y,
                    p.z};
    };
    const std::string why = "round-off, grown in some collisions";
    checks.add_bound("mirrored", "1", 1e-6, apart({}, mirror, mirror_axial, {}), why);
    checks.add_bound("turned by a quarter", "1", 1e-6, apart({}, quarter, quarter, {}), why);
    checks.add_bound("turned aslant", "1", 1e-6, apart({}, aslant, aslant, {}), why);
    checks.add_bound("moved by 1 m", "1", 1e-6, apart({}, same, same, {1.0, -1.0, 1.0}), why);
    checks.add_bound("in mm, g and ms",
                     "1",
                     1e-6,
                     apart({.length = 1e-3, .mass = 1e-3, .time = 1e-3}, same, same, {}),
                     why);
    checks.add_bound("1 km away",
                     "1",
                     1e-3,
                     apart({}, same, same, {600.0, 600.0, 600.0}),
                     "positions end at 1e-13 m, and overlaps are their differences");
}

void check_denormals(Checks& checks) {
    const double tiny = std::numeric_limits<double>::denorm_min();
    for (const double scale : {1e-300, 1e-310, tiny}) {
        Scene scene = tumble(
            {}, [](const Vec3& v) { return v; }, [](const Vec3& v) { return v; }, {});
        scene.gravity = Vec3{0.0, 0.0, -scale};
        for (Placement& ball :
             std::get<ListInsertion>(scene.particles.insertion.back()).particles) {
            ball.velocity = scale * Vec3{1.0, 1.0, 1.0};
            ball.angular_velocity = scale * Vec3{1.0, 0.0, 1.0};
        }
        Run run(scene);
        const Ending ending = watch(run, 1000);
        checks.add_claim("runs on at speeds of " + text_of(scale) + " m/s", !ending.stopped);
        checks.add_bound("kinetic energy at speeds of " + text_of(scale) + " m/s",
                         "J",
                         0.0,
                         run.now("kinetic_energy"),
                         "none");
    }
}

void check_little(Checks& checks) {
    for (const int count : {0, 1}) {
        for (const double duration : {0.0, 1e-3}) {
            Scene scene = scene_of({.normal = 1e5, .damping = 0.1}, 1e-5, duration);
            scene.gravity = Vec3{0.0, 0.0, -9.8};
            scene.timestep = automatic_step(0.8);
            scene.observables.energy = EnergyObservable{};
            add_plane(scene, "floor", {}, {0.0, 0.0, 1.0});
            scene.walls.back().motion = ConstantMotion{.velocity = {0.0, 0.0, 0.1}};
            if (count > 0) {
                add_sphere(scene, {0.0, 0.0, r});
            }
            Stage empty;
            empty.duration = 0.0;
            empty.timestep = FixedTimestep{.value = 1e-5};
            scene.stages.push_back(empty);
            scene.stages.push_back(empty);
            Run run(scene);
            const Ending ending = watch(run, ~std::uint64_t{0});
            const std::string label = ", " + std::to_string(count) + " particles, stages of " +
                                      text_of(duration) + ", 0 and 0 s";
            checks.add_claim("runs to its end" + label,
                             !ending.stopped && run.simulation().finished());
            checks.add_claim("its numbers are finite" + label,
                             std::isfinite(mechanical_energy(run)) &&
                                 std::isfinite(run.simulation().timestep()));
            checks.add_claim("makes cycles where there is time" + label,
                             (run.simulation().cycle() > 0) == (duration > 0.0));
        }
    }
}

}  // namespace

std::vector<Case> stable_frame_cases() {
    return {{.name = "stability/frame",
             .section = "3",
             .title = "mirrored, turned, moved, in mm-g-ms, and 1 km away",
             .run = check_frames},
            {.name = "stability/denormals",
             .section = "3",
             .title = "speeds below the smallest normal number",
             .run = check_denormals},
            {.name = "stability/little",
             .section = "3",
             .title = "no particle, one particle, stages without length",
             .run = check_little}};
}

}  // namespace grainbench::verify
