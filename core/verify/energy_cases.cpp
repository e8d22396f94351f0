#include "core/verify/registry.hpp"
#include "core/verify/run.hpp"
#include "core/verify/scenes.hpp"

namespace grainbench::verify {

namespace {

constexpr double stiffness = 1e5;

Scene ledger_scene(double steps, bool pair, bool moving) {
    const double r = small_sphere.radius;
    const double mass = pair ? 0.5 * small_sphere.mass() : small_sphere.mass();
    const double dt = half_period(mass, stiffness) / steps;
    Scene scene = scene_of({.normal = stiffness,
                            .shear = stiffness,
                            .friction = 0.3,
                            .damping = 0.1,
                            .damping_mode = 3},
                           dt,
                           1.5 * steps * dt);
    scene.gravity = Vec3{0.0, 0.0, -9.8};
    const double gap = 1e-6;
    if (pair) {
        add_sphere(scene, {-r - gap, 0.0, 0.0}, {1.0, 0.0, 0.8}, {0.0, 150.0, 20.0});
        add_sphere(scene, {r + gap, 0.0, 0.0}, {-1.0, 0.3, -0.8}, {10.0, 150.0, -30.0});
    } else {
        add_plane(scene, "floor", {}, {0.0, 0.0, 1.0});
        if (moving) {
            scene.walls.back().motion = ConstantMotion{.velocity = {0.1, 0.0, 0.5}};
        }
        add_sphere(scene, {0.0, 0.0, r + gap}, {0.7, 0.2, -1.0}, {30.0, 0.0, 100.0});
    }
    scene.observables.energy = EnergyObservable{};
    return scene;
}

struct Ledger {
    double start = 0.0;      ///< [J] kinetic
    double lost = 0.0;       ///< [J] kinetic, potential and elastic, less the work of walls
    double slip = 0.0;       ///< [J]
    double dashpot = 0.0;    ///< [J]
    double numerical = 0.0;  ///< [J]
};

Ledger ledger_of(const Scene& scene) {
    Run run(scene);
    run.advance(0);
    const auto mechanical = [&] {
        return run.now("energy_kinetic_translation") + run.now("energy_kinetic_rotation") +
               run.now("energy_potential") + run.now("energy_elastic");
    };
    const double before = mechanical();
    const double kinetic = run.now("kinetic_energy");
    run.finish();
    return {.start = kinetic,
            .lost = before - mechanical() + run.now("energy_wall_work"),
            .slip = run.now("energy_dissipated_slip"),
            .dashpot = run.now("energy_dissipated_dashpot"),
            .numerical = run.now("energy_numerical")};
}

void check_ledger(Checks& checks, bool pair, bool moving, LeverArm lever_arm) {
    Scene scene = ledger_scene(4000.0, pair, moving);
    scene.contact.lever_arm = lever_arm;
    const Ledger ledger = ledger_of(scene);
    checks.add("lost, over the start's kinetic energy",
               "1",
               (ledger.slip + ledger.dashpot) / ledger.start,
               ledger.lost / ledger.start,
               {3e-6, "made or lost by the scheme at 4000 steps in an impact"});
    checks.add("made or lost by the scheme, over the same",
               "1",
               0.0,
               ledger.numerical / ledger.start,
               {3e-6, "first order in dt where dashpots take hold, 4000 steps in an impact"});
    checks.add(
        "slip and dashpots both lose",
        "1",
        1.0,
        ledger.slip > 1e-3 * ledger.start && ledger.dashpot > 1e-3 * ledger.start ? 1.0 : 0.0,
        exact());
}

Case ledger_case(const char* name,
                 const char* title,
                 bool pair,
                 bool moving,
                 LeverArm lever_arm = LeverArm::contact_point) {
    return {.name = name, .section = "10.12", .title = title, .run = [=](Checks& checks) {
                check_ledger(checks, pair, moving, lever_arm);
            }};
}

/// The bed of presets/scenes/calibration.json, shaken as there from the moment it begins to fall.
Scene shaken_bed(double timestep) {
    Scene scene = scene_of({.normal = stiffness,
                            .shear = stiffness,
                            .incremental = true,
                            .friction = 0.6,
                            .damping = 0.02,
                            .damping_mode = 3},
                           timestep,
                           0.3);
    add_species(scene, "large", intruder);
    scene.gravity = Vec3{0.0, 0.0, -9.8};
    const auto fill = [](const char* species, double low, double high) {
        return RandomInsertion{.species = species,
                               .count = 100000,
                               .tries = 1000000,
                               .box = {{-0.25, -0.05, low}, {0.25, 0.05, high}},
                               .inside = "container"};
    };
    scene.particles.insertion = {fill("ball", -0.07, -0.01), fill("large", -0.1, -0.07)};
    scene.particles.removal = {{.axis = Axis::z, .low = -0.04}, {.axis = Axis::z, .high = -0.08}};
    Wall container;
    container.name = "container";
    container.shape =
        FacetedCylinder{.base = {0.0, 0.0, -0.1}, .radius = 0.05, .height = 0.2, .resolution = 0.5};
    container.motion = SmoothedSquareMotion{.frequency = 10.0, .amplitude = 0.35};
    scene.walls.push_back(std::move(container));
    scene.observables.energy = EnergyObservable{};
    return scene;
}

/// The ledger's account of the shaken bed. What the scheme makes or loses has a column of its own;
/// the claim is that the books close without it once the step is small, and how fast they do.
void check_shaken_bed(Checks& checks) {
    const auto lost_by_scheme = [&](double timestep) {
        Run run(shaken_bed(timestep));
        run.finish();
        const double work = run.now("energy_wall_work");
        checks.add_bound("with all columns, over the work of the walls, step " + text_of(timestep),
                         "1",
                         1e-8,
                         run.now("energy_residual") / work,
                         "dt^2/8 times gravity times the contact forces, with 10 N at the most");
        return run.now("energy_numerical") / work;
    };
    const double coarse = lost_by_scheme(5e-6);
    const double fine = lost_by_scheme(1.25e-6);
    checks.add_bound("without the scheme's column, over the work of the walls, step 1.25e-06",
                     "1",
                     1e-3,
                     fine,
                     "second order in the step: a sixteenth of the automatic step's plateau");
    checks.add("order in the step of what the scheme loses",
               "1",
               2.0,
               0.5 * std::log2(coarse / fine),
               {0.15, "two chaotic beds, and 18 steps in an impact at the coarser step"});
}

}  // namespace

std::vector<Case> energy_cases() {
    return {
        ledger_case("energy/plane", "ledger of a damped impact with friction", false, false),
        ledger_case("energy/moving-plane", "the same on a plane that moves", false, true),
        ledger_case("energy/pair", "the same of two balls", true, false),
        ledger_case("energy/pair-lever-of-radius",
                    "the same with levers as long as the radius",
                    true,
                    false,
                    LeverArm::radius),
        {.name = "energy/shaken-bed",
         .section = "10.12",
         .title = "ledger of the shaken bed of the example",
         .run = check_shaken_bed},
    };
}

}  // namespace grainbench::verify
