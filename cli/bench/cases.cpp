#include "cli/bench/cases.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <utility>

namespace grainbench::cli {

namespace {

constexpr double small_radius = 0.003;
constexpr double stiffness = 1e5;

/// Longer than any benchmark runs: the last stage must not end.
constexpr double for_ever = 1e9;

Contact spring(NormalLaw law, double k) {
    Contact contact;
    contact.stiffness = ConstantStiffness::Params{.normal = k, .shear = k};
    contact.normal = std::move(law);
    return contact;
}

CoulombFriction::Params example_friction() {
    return {.coefficient = 0.6};
}

ViscousDamping::Params example_damping() {
    return {.normal = 0.02, .shear = 0.02, .mode = 3};
}

/// The laws and numbers of presets/scenes/bne.json.
Contact example_contact() {
    Contact contact = spring(IncrementalSpring::Params{}, stiffness);
    contact.friction = example_friction();
    contact.damping = example_damping();
    return contact;
}

/// The same laws with dashpots that bring a bed to rest.
Contact settling(Contact contact) {
    contact.damping = ViscousDamping::Params{.normal = 0.3, .shear = 0.3, .mode = 0};
    return contact;
}

Stage stage_of(double duration, const Contact& contact, std::optional<Timestep> timestep = {}) {
    Stage stage;
    stage.duration = duration;
    stage.contact = contact;
    stage.timestep = std::move(timestep);
    return stage;
}

RandomInsertion fill(const char* species, double low, double high) {
    return {.species = species,
            .count = 100000,
            .tries = 1000000,
            .box = {{-0.25, -0.05, low}, {0.25, 0.05, high}},
            .inside = "container"};
}

/// Container and bed of presets/scenes/bne.json, without what it measures and writes.
Scene example_bed() {
    Scene scene;
    scene.gravity = Vec3{0.0, 0.0, -9.8};
    scene.particles.species = {{"small", small_radius, 1500.0}, {"large", 0.006, 2500.0}};
    scene.particles.insertion = {fill("small", -0.07, -0.01), fill("large", -0.1, -0.07)};
    scene.walls = {
        {.name = "container",
         .shape =
             FacetedCylinder{
                 .base = {0.0, 0.0, -0.1}, .radius = 0.05, .height = 0.2, .resolution = 0.5},
         .motion = FixedMotion{},
         .material = {}}};
    scene.contact = example_contact();
    return scene;
}

Scene shaken_bed(const Timestep& timestep) {
    Scene scene = example_bed();
    scene.timestep = timestep;
    Stage stage;
    stage.duration = for_ever;
    stage.motions = {{"container", SmoothedSquareMotion{.frequency = 10.0, .amplitude = 0.35}}};
    scene.stages = {stage};
    return scene;
}

Scene bed_at_rest() {
    Scene scene = example_bed();
    scene.contact = settling(example_contact());
    scene.stages = {stage_of(0.6, scene.contact), stage_of(for_ever, example_contact())};
    return scene;
}

/// Spheres in a hexagonal packing that fits its box, 0.02 percent loose: it settles at once, and
/// which of its contacts close is as irregular as the first displacements, which are larger than
/// the overlaps that weight makes.
Scene packed_box(int nx, int ny, int nz) {
    constexpr double half = 1.0002 * small_radius;
    constexpr double jitter = 0.00015 * small_radius;
    std::mt19937_64 random(10001);
    const auto moved = [&](double x) {
        return x + jitter * (static_cast<double>(random() >> 11) * 0x1p-52 - 1.0);
    };
    ListInsertion list;
    for (int k = 0; k < nz; ++k) {
        for (int j = 0; j < ny; ++j) {
            for (int i = 0; i < nx; ++i) {
                const double x = half * (1.0 + 2.0 * i + (j + k) % 2);
                const double y = half * (1.0 + std::sqrt(3.0) * (j + (k % 2) / 3.0));
                const double z = half * (1.0 + std::sqrt(8.0 / 3.0) * k);
                list.particles.push_back(
                    {.species = "small", .position = {moved(x), moved(y), moved(z)}});
            }
        }
    }
    Scene scene;
    scene.gravity = Vec3{0.0, 0.0, -9.8};
    scene.particles.species = {{"small", small_radius, 1500.0}};
    scene.particles.insertion = {std::move(list)};
    const double width = half * (2.0 * nx + 1.0);
    const double depth = half * (2.0 + std::sqrt(3.0) * (ny - 1 + 1.0 / 3.0));
    const double height = half * (4.0 + std::sqrt(8.0 / 3.0) * nz);
    scene.walls = {{.name = "box",
                    .shape = BoxShape{{0.0, 0.0, 0.0}, {width, depth, height}},
                    .motion = FixedMotion{},
                    .material = {}}};
    return scene;
}

/// Settled with softer springs, whose step is ten times longer; the incremental spring keeps its
/// force when the stiffness changes, so the bed stays at rest.
///
/// \param along balls along two sides of the box, which is ten layers deep
Scene ten_layers_at_rest(int along) {
    Scene scene = packed_box(along, along, 10);
    Contact soft = example_contact();
    soft.stiffness = ConstantStiffness::Params{.normal = 0.1 * stiffness, .shear = 0.1 * stiffness};
    scene.contact = settling(soft);
    scene.stages = {stage_of(0.02, scene.contact), stage_of(for_ever, example_contact())};
    return scene;
}

/// Half a drum of balls, from a lattice that settles with softer springs; then it turns and they
/// avalanche and mix. It is longer than it is wide, so that slots are in layers along its axis.
///
/// \param radius, length of the drum [m]
Scene drum(double radius, double length) {
    constexpr double spacing = 2.02 * small_radius;
    std::mt19937_64 random(10001);
    const auto moved = [&](double x) {
        return x + 0.005 * small_radius * (static_cast<double>(random() >> 11) * 0x1p-52 - 1.0);
    };
    const auto across = static_cast<int>(radius / spacing);
    const auto along = static_cast<int>(length / spacing);
    ListInsertion list;
    for (int k = -across; k < 0; ++k) {
        for (int i = -across; i <= across; ++i) {
            if (std::hypot(i * spacing, k * spacing) > radius - 1.02 * small_radius) {
                continue;
            }
            for (int j = 0; j < along; ++j) {
                list.particles.push_back(
                    {.species = "small",
                     .position = {
                         moved(i * spacing), moved((j + 0.5) * spacing), moved(k * spacing)}});
            }
        }
    }
    Scene scene;
    scene.gravity = Vec3{0.0, 0.0, -9.8};
    scene.particles.species = {{"small", small_radius, 1500.0}};
    scene.particles.insertion = {std::move(list)};
    scene.walls = {
        {.name = "drum",
         .shape = Cylinder{.base = {}, .axis = {0.0, 1.0, 0.0}, .radius = radius, .height = length},
         .motion = FixedMotion{},
         .material = {}}};
    Contact soft = example_contact();
    soft.stiffness = ConstantStiffness::Params{.normal = 0.1 * stiffness, .shear = 0.1 * stiffness};
    scene.contact = settling(soft);
    Stage turning = stage_of(for_ever, example_contact());
    turning.motions = {{"drum", RotationMotion{.point = {}, .axis = {0.0, 1.0, 0.0}, .rate = 3.0}}};
    scene.stages = {stage_of(0.1, scene.contact), turning};
    return scene;
}

Scene effects_bed(const Contact& contact, Scene scene) {
    scene.contact = settling(contact);
    scene.stages = {stage_of(0.015, scene.contact),
                    stage_of(for_ever, contact, FixedTimestep{5e-6})};
    return scene;
}

BenchCase effects_case(const char* name, const char* about, const Contact& contact) {
    return {.name = std::string("effects/") + name,
            .about = about,
            .scene = [contact] { return effects_bed(contact, packed_box(20, 20, 10)); },
            .prepared = 0.016,
            .span = 0.002,
            .repetitions = 7};
}

Contact linear_contact() {
    return spring(LinearSpring::Params{}, stiffness);
}

Contact damped_contact() {
    Contact contact = linear_contact();
    contact.damping = example_damping();
    return contact;
}

Contact rough_contact() {
    Contact contact = linear_contact();
    contact.friction = example_friction();
    return contact;
}

Contact incremental_contact() {
    return spring(IncrementalSpring::Params{}, stiffness);
}

/// Laws beyond those of the linear contact.
std::vector<BenchCase> further_effects() {
    Contact rolling = rough_contact();
    rolling.damping = example_damping();
    Contact cohesive = rolling;
    cohesive.cohesion = LinearCohesion::Params{1e-4, 1e-6};
    rolling.rolling = RollingResistance::Params{0.05};
    Contact twisting = rolling;
    twisting.twisting = TwistingResistance::Params{0.05};
    Contact hertz;
    hertz.stiffness = HertzStiffness::Params{.young_modulus = 1e8, .poisson_ratio = 0.3};
    hertz.normal = HertzSpring::Params{};
    Contact mindlin = hertz;
    mindlin.friction = MindlinFriction::Params{0.6};
    mindlin.damping = RestitutionDamping::Params{0.9};
    Contact adhesive = mindlin;
    adhesive.normal = JkrAdhesion::Params{1e-4};
    Contact yielding = spring(WaltonBraunSpring::Params{0.9}, stiffness);
    yielding.friction = example_friction();
    Contact everything = twisting;
    everything.cohesion = cohesive.cohesion;
    Contact cohesive_mindlin = mindlin;
    cohesive_mindlin.cohesion = cohesive.cohesion;
    Contact turning_mindlin = mindlin;
    turning_mindlin.rolling = twisting.rolling;
    turning_mindlin.twisting = twisting.twisting;
    Contact turning_adhesive = adhesive;
    turning_adhesive.rolling = twisting.rolling;
    turning_adhesive.twisting = twisting.twisting;
    return {
        effects_case("walton_braun_spring",
                     "latching spring alone",
                     spring(WaltonBraunSpring::Params{0.9}, stiffness)),
        effects_case("walton_braun_with_friction", "the same with friction", yielding),
        effects_case(
            "linear_with_cohesion", "absolute spring, friction, dashpots, cohesion", cohesive),
        effects_case("linear_with_rolling",
                     "absolute spring, friction, dashpots, rolling resistance",
                     rolling),
        effects_case("linear_with_rolling_and_twisting", "the same with twisting", twisting),
        effects_case("linear_with_cohesion_rolling_and_twisting",
                     "the same with cohesion: all that linear springs allow",
                     everything),
        effects_case("hertz_spring", "Hertz's spheres without friction or dashpots", hertz),
        effects_case("hertz_mindlin", "the same with friction and dashpots", mindlin),
        effects_case("hertz_mindlin_with_cohesion", "the same with cohesion", cohesive_mindlin),
        effects_case("hertz_mindlin_with_rolling_and_twisting",
                     "Hertz, Mindlin, dashpots, rolling resistance, twisting",
                     turning_mindlin),
        effects_case("jkr_adhesion", "Hertz, Mindlin, dashpots, adhesion", adhesive),
        effects_case("jkr_adhesion_with_rolling_and_twisting",
                     "the same with rolling resistance and twisting",
                     turning_adhesive),
    };
}

BenchCase counted_case(const char* name, const Contact& contact) {
    return {.name = name,
            .about = "384 balls at rest",
            .scene = [contact] { return effects_bed(contact, packed_box(8, 8, 6)); },
            .prepared = 0.016,
            .span = 0.001,
            .repetitions = 1};
}

/// Balls that fly about in free space and meet: no walls, friction, dashpots or gravity.
Scene cloud() {
    Scene scene = packed_box(8, 8, 6);
    scene.gravity.reset();
    scene.walls.clear();
    std::mt19937_64 random(10002);
    const auto speed = [&] { return 0.2 * (static_cast<double>(random() >> 11) * 0x1p-52 - 1.0); };
    for (Placement& ball : std::get<ListInsertion>(scene.particles.insertion[0]).particles) {
        ball.velocity = {speed(), speed(), speed()};
    }
    scene.contact = linear_contact();
    scene.timestep = FixedTimestep{5e-6};
    scene.stages = {stage_of(for_ever, scene.contact)};
    return scene;
}

/// Thrown about within a period short enough to be counted whole.
Scene small_shaken_box(const Timestep& timestep) {
    Scene scene = packed_box(8, 8, 6);
    scene.contact = example_contact();
    scene.timestep = timestep;
    Stage stage;
    stage.duration = for_ever;
    stage.motions = {{"box", SmoothedSquareMotion{.frequency = 40.0, .amplitude = 0.35}}};
    scene.stages = {stage};
    return scene;
}

}  // namespace

std::vector<BenchCase> bench_cases() {
    std::vector<BenchCase> cases{
        {.name = "shaken_bed/fixed_step",
         .about = "the example's bed, shaken at 10 Hz, step 1e-5 s, over one period",
         .scene = [] { return shaken_bed(FixedTimestep{1e-5}); },
         .prepared = 0.3,
         .span = 0.1,
         .repetitions = 5},
        {.name = "shaken_bed/automatic_step",
         .about = "the same with the automatic step",
         .scene = [] { return shaken_bed(AutomaticTimestep{}); },
         .prepared = 0.3,
         .span = 0.1,
         .repetitions = 5},
        {.name = "bed_at_rest",
         .about = "the same bed, settled, automatic step",
         .scene = bed_at_rest,
         .prepared = 1.6,
         .span = 0.02,
         .repetitions = 7},
        {.name = "medium_bed_at_rest",
         .about = "10240 balls in a box, settled, automatic step",
         .scene = [] { return ten_layers_at_rest(32); },
         .prepared = 0.021,
         .span = 0.0005,
         .repetitions = 5},
        {.name = "large_bed_at_rest",
         .about = "100000 balls in a box, settled, automatic step",
         .scene = [] { return ten_layers_at_rest(100); },
         .prepared = 0.021,
         .span = 0.0005,
         .repetitions = 5},
        {.name = "million_bed_at_rest",
         .about = "998560 balls in a box, settled, automatic step",
         .scene = [] { return ten_layers_at_rest(316); },
         .prepared = 0.021,
         .span = 0.0005,
         .repetitions = 5,
         .is_on_request = true},
        {.name = "drum",
         .about = "100000 balls in a drum that turns at 3 rad/s, automatic step",
         .scene = [] { return drum(0.1, 1.6); },
         .prepared = 0.15,
         .span = 0.003,
         .repetitions = 5,
         .is_on_request = true},
        {.name = "million_drum",
         .about = "a million balls in a drum that turns at 3 rad/s, automatic step",
         .scene = [] { return drum(0.22, 3.07); },
         .prepared = 0.12,
         .span = 0.0001,
         .repetitions = 5,
         .is_on_request = true},
        effects_case(
            "linear_spring", "4000 balls at rest: absolute normal spring alone", linear_contact()),
        effects_case("linear_spring_and_damping", "the same with dashpots", damped_contact()),
        effects_case("linear_spring_and_friction", "the same with friction", rough_contact()),
        effects_case(
            "incremental_spring", "incremental normal spring alone", incremental_contact()),
        effects_case("all", "incremental spring, friction and dashpots", example_contact()),
    };
    for (BenchCase& one : further_effects()) {
        cases.push_back(std::move(one));
    }
    return cases;
}

std::vector<BenchCase> counted_cases() {
    return {{.name = "shaken",
             .about = "384 balls in a shaken box, over one period",
             .scene = [] { return small_shaken_box(FixedTimestep{1e-5}); },
             .prepared = 0.1,
             .span = 0.025,
             .repetitions = 1},
            {.name = "shaken_automatic_step",
             .about = "the same with the automatic step",
             .scene = [] { return small_shaken_box(AutomaticTimestep{}); },
             .prepared = 0.1,
             .span = 0.025,
             .repetitions = 1},
            {.name = "cloud",
             .about = "384 balls that meet in free space: a normal spring alone, a fixed step",
             .scene = cloud,
             .prepared = 0.001,
             .span = 0.005,
             .repetitions = 1},
            counted_case("rest_linear_spring", linear_contact()),
            counted_case("rest_linear_spring_and_damping", damped_contact()),
            counted_case("rest_linear_spring_and_friction", rough_contact()),
            counted_case("rest_incremental_spring", incremental_contact()),
            counted_case("rest_all", example_contact())};
}

}  // namespace grainbench::cli
