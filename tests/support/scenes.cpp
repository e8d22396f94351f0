#include "tests/support/scenes.hpp"

#include <algorithm>
#include <array>
#include <random>

namespace grainbench::test {

namespace {

/// Uniform in [low, high) by a formula of our own: the standard distributions differ between
/// libraries, and the seeds below were chosen with care.
double between(std::mt19937_64& random, double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

std::vector<Placement> flying_spheres(std::uint64_t seed) {
    constexpr double cell = 0.0225;  // wider than the largest sphere
    std::vector<Vec3> cells;
    for (int n = 0; n < 64; ++n) {
        cells.push_back({cell * (n % 4 - 1.5), cell * (n / 4 % 4 - 1.5), cell * (n / 16 - 1.5)});
    }
    std::mt19937_64 random(seed);
    for (std::size_t n = cells.size(); n-- > 1;) {
        std::swap(cells[n], cells[random() % (n + 1)]);
    }
    const std::array<const char*, 3> names{"small", "middle", "large"};
    std::vector<Placement> spheres;
    for (std::size_t n = 0; n < 60; ++n) {
        const auto speed = [&] { return between(random, -1.0, 1.0); };
        Placement sphere{.species = names[n % 3], .position = cells[n]};
        sphere.velocity = {speed(), speed(), speed()};
        sphere.angular_velocity = {50.0 * speed(), 50.0 * speed(), 50.0 * speed()};
        spheres.push_back(sphere);
    }
    return spheres;
}

RandomInsertion insertion(
    const char* species, std::int64_t tries, double radius, double low, double high) {
    return {.species = species,
            .count = 100000,
            .tries = tries,
            .box = {{-radius, -radius, low}, {radius, radius, high}},
            .inside = "container"};
}

/// Ten times the usual: random insertion leaves a loose bed, and this one is to lie packed within a
/// few hundredths of a second.
constexpr Vec3 strong_gravity{0.0, 0.0, -98.0};

Wall container(double radius, double base, double height) {
    return {
        .name = "container",
        .shape =
            FacetedCylinder{
                .base = {0.0, 0.0, base}, .radius = radius, .height = height, .resolution = 0.5},
        .motion = FixedMotion{},
        .material = {}};
}

Stage shaken_stage(double duration, double frequency, double amplitude) {
    Stage stage;
    stage.duration = duration;
    stage.motions = {
        {"container", SmoothedSquareMotion{.frequency = frequency, .amplitude = amplitude}}};
    return stage;
}

}  // namespace

Contact full_contact(double stiffness, double damping) {
    Contact contact;
    contact.stiffness = ConstantStiffness::Params{.normal = stiffness, .shear = stiffness};
    contact.normal = IncrementalSpring::Params{};
    contact.friction = CoulombFriction::Params{.coefficient = 0.6};
    contact.damping = ViscousDamping::Params{.normal = damping, .shear = damping, .mode = 3};
    return contact;
}

Scene gas_in_box(std::uint64_t seed) {
    Scene scene;
    scene.gravity = Vec3{0.0, 0.0, -9.8};
    scene.particles.species = {
        {"small", 0.003, 1500.0}, {"middle", 0.005, 1500.0}, {"large", 0.008, 2500.0}};
    scene.particles.insertion = {ListInsertion{.particles = flying_spheres(seed)}};
    scene.walls = {{.name = "box",
                    .shape = BoxShape{{-0.046, -0.046, -0.055}, {0.046, 0.046, 0.046}},
                    .motion = FixedMotion{},
                    .material = {}},
                   {.name = "plate",
                    .shape = Disc{.centre = {0.0, 0.0, -0.048}, .radius = 0.07},
                    .motion = SinusoidMotion{.velocity = {0.0, 0.0, 0.3}, .frequency = 20.0},
                    .material = {}}};
    scene.contact = full_contact(1e4, 0.02);
    scene.timestep = FixedTimestep{2e-5};
    Stage stage;
    stage.duration = 1.0;
    scene.stages = {stage};
    return scene;
}

Scene shaken_bed() {
    Scene scene;
    scene.gravity = strong_gravity;
    scene.particles.species = {{"small", 0.003, 1500.0}, {"large", 0.006, 2500.0}};
    scene.particles.insertion = {insertion("small", 20000, 0.05, -0.07, -0.04),
                                 insertion("large", 4000, 0.05, -0.1, -0.07)};
    scene.particles.removal = {{Axis::z, -1.0, -0.08}};
    scene.walls = {container(0.05, -0.1, 0.2)};
    scene.contact = full_contact(1e5, 0.2);
    scene.timestep = FixedTimestep{1e-5};
    scene.stages = {shaken_stage(2.0, 10.0, 0.35)};
    return scene;
}

Scene thrown_bed() {
    Scene scene;
    scene.gravity = strong_gravity;
    scene.particles.species = {{"small", 0.002, 1500.0}, {"large", 0.004, 2500.0}};
    scene.particles.insertion = {insertion("small", 20000, 0.02, -0.02, 0.0),
                                 insertion("large", 2000, 0.02, -0.03, -0.02)};
    scene.walls = {container(0.02, -0.03, 0.06)};
    scene.contact = full_contact(1e4, 0.2);
    Stage second = shaken_stage(0.01, 100.0, 0.5);
    second.contact = full_contact(2e4, 0.3);
    second.contact->normal = LinearSpring::Params{};
    second.timestep = FixedTimestep{5e-6};
    scene.stages = {shaken_stage(0.03, 50.0, 0.5), second};
    scene.groups = {{.name = "small", .species = "small", .box = {}},
                    {.name = "large", .species = "large", .box = {}}};
    scene.observables.elevation = ElevationObservable{
        .upper = "large", .lower = "small", .sample_cycles = 10, .average_interval = 0.004};
    scene.observables.energy = EnergyObservable{};
    scene.observables.wall_forces = WallForceObservable{};
    scene.traces = {{.nearest_to = {0.0, 0.0, -0.03}, .species = {}},
                    {.nearest_to = {0.02, 0.0, 0.0}, .species = "small"}};
    scene.realisations.count = 3;
    scene.output.history_cycles = 37;
    scene.output.trace_interval = 1e-4;
    return scene;
}

Scene carried_bed() {
    Scene scene;
    scene.gravity = Vec3{10.0, 0.0, -97.0};
    scene.periodic = Periodic{.x = Interval{0.0, 0.03}, .y = Interval{0.0, 0.02}, .z = {}};
    scene.particles.species = {{"small", 0.002, 1500.0}, {"large", 0.003, 2500.0}};
    scene.particles.insertion = {LatticeInsertion{.species = "small",
                                                  .origin = {0.003, 0.003, 0.003},
                                                  .spacing = {0.005, 0.005, 0.005},
                                                  .counts = {6, 4, 3},
                                                  .jitter = 0.0004},
                                 RandomInsertion{.species = "large",
                                                 .count = 10,
                                                 .tries = 1000,
                                                 .box = {{0.0, 0.0, 0.016}, {0.03, 0.02, 0.03}},
                                                 .inside = {}}};
    scene.walls = {{.name = "belt",
                    .shape = Plane{.point = {}, .normal = {0.0, 0.0, 1.0}},
                    .motion = ConstantMotion{.velocity = {0.5, 0.0, 0.0}},
                    .material = {}}};
    scene.contact = full_contact(1e4, 0.3);
    scene.timestep = FixedTimestep{1e-5};
    scene.groups = {{.name = "all", .species = {}, .box = {}}};
    scene.traces = {{.nearest_to = {0.015, 0.01, 0.01}, .species = {}}};
    scene.observables.energy = EnergyObservable{};
    scene.output.history_cycles = 37;
    scene.output.trace_interval = 1e-4;
    Stage stage;
    stage.duration = 0.1;
    scene.stages = {stage};
    return scene;
}

Scene mixing_gas() {
    constexpr int along = 24;
    constexpr double cell = 0.006;
    constexpr double half = 0.5 * along * cell;
    std::mt19937_64 random(5);
    ListInsertion list;
    for (int n = 0; n < along * along * along; ++n) {
        const auto speed = [&] { return between(random, -10.0, 10.0); };
        Placement sphere{.species = "small",
                         .position = {cell * (n % along + 0.5) - half,
                                      cell * (n / along % along + 0.5) - half,
                                      cell * (n / along / along + 0.5) - half}};
        sphere.velocity = {speed(), speed(), speed()};
        list.particles.push_back(sphere);
    }
    Scene scene;
    scene.particles.species = {{"small", 0.002, 1500.0}};
    scene.particles.insertion = {std::move(list)};
    scene.walls = {{.name = "box",
                    .shape = BoxShape{{-half, -half, -half}, {half, half, half}},
                    .motion = FixedMotion{},
                    .material = {}}};
    scene.contact = full_contact(1e5, 0.02);
    scene.timestep = FixedTimestep{1e-5};
    Stage stage;
    stage.duration = 0.008;
    scene.stages = {stage};
    return scene;
}

Scene with_traffic(Scene scene) {
    scene.particles.sources = {{.name = "inlet",
                                .species = "small",
                                .box = {{-0.015, -0.015, 0.015}, {0.015, 0.015, 0.028}},
                                .rate = 5000.0,
                                .count = {},
                                .velocity = {0.0, 0.0, -0.5},
                                .end = {}}};
    scene.particles.sinks = {{.name = "corner", .box = Box{{0.005, 0.005, -1.0}, {1.0, 1.0, 1.0}}}};
    return scene;
}

}  // namespace grainbench::test
