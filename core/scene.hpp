/// Plain description of a run: what the JSON says, with units and defaults, and nothing else. No
/// pointers, no JSON, no behaviour; core/simulation.hpp builds the running state from it. SI units.
#pragma once

#include "core/box.hpp"
#include "core/contact/laws/constant_stiffness.hpp"
#include "core/contact/laws/coulomb_friction.hpp"
#include "core/contact/laws/deformability_stiffness.hpp"
#include "core/contact/laws/hertz_spring.hpp"
#include "core/contact/laws/hertz_stiffness.hpp"
#include "core/contact/laws/incremental_spring.hpp"
#include "core/contact/laws/jkr_adhesion.hpp"
#include "core/contact/laws/linear_cohesion.hpp"
#include "core/contact/laws/linear_spring.hpp"
#include "core/contact/laws/mindlin_friction.hpp"
#include "core/contact/laws/restitution_damping.hpp"
#include "core/contact/laws/rolling_resistance.hpp"
#include "core/contact/laws/twisting_resistance.hpp"
#include "core/contact/laws/viscous_damping.hpp"
#include "core/contact/laws/walton_braun_spring.hpp"
#include "core/describe.hpp"
#include "core/guards/guards.hpp"
#include "core/types.hpp"
#include "core/walls/motion.hpp"
#include "core/walls/shapes.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace grainbench {

// --- particles -----------------------------------------------------------------------------------

/// A kind of sphere; its name doubles as the material in contact.pairs.
struct Species {
    std::string name;
    double radius = 0.0;
    double density = 0.0;

    static constexpr auto fields() {
        return std::tuple{
            required(&Species::name, "name", "", any_number(), "name, unique among species"),
            required(&Species::radius, "radius", "m", positive(), "radius of the spheres"),
            required(
                &Species::density, "density", "kg/m^3", positive(), "density of the material")};
    }
};

/// Random sequential insertion without overlap: every candidate drawn in the box counts as a try.
struct RandomInsertion {
    static constexpr std::string_view key = "random";
    std::string species;
    std::int64_t count = 0;
    std::int64_t tries = 20000;
    Box box;
    std::optional<std::string> inside;

    static constexpr auto fields() {
        return std::tuple{
            required(&RandomInsertion::species, "species", "", any_number(), "name of the species"),
            required(&RandomInsertion::count, "count", "1", at_least(0), "number asked for"),
            field(&RandomInsertion::tries,
                  "tries",
                  "1",
                  at_least(1),
                  "placement attempts in all; insertion ends when count or tries is reached"),
            required(&RandomInsertion::box,
                     "box",
                     "m",
                     any_number(),
                     "box that bounds the surfaces of the spheres"),
            field(&RandomInsertion::inside,
                  "inside",
                  "",
                  any_number(),
                  "name of a closed wall that must hold the sphere entirely")};
    }
};

/// Simple cubic lattice: counts[k] spheres along axis k, first centre at origin.
struct LatticeInsertion {
    static constexpr std::string_view key = "lattice";
    std::string species;
    Vec3 origin{};
    Vec3 spacing{};
    std::vector<std::int64_t> counts;
    Vec3 velocity{};
    double jitter = 0.0;

    static constexpr auto fields() {
        return std::tuple{
            required(
                &LatticeInsertion::species, "species", "", any_number(), "name of the species"),
            required(&LatticeInsertion::origin, "origin", "m", any_number(), "first centre"),
            required(&LatticeInsertion::spacing,
                     "spacing",
                     "m",
                     at_least(0.0),
                     "distance between centres along x, y, z"),
            required(&LatticeInsertion::counts,
                     "counts",
                     "1",
                     at_least(1),
                     "three numbers of spheres, along x, y, z"),
            field(&LatticeInsertion::velocity, "velocity", "m/s", any_number(), "initial velocity"),
            field(&LatticeInsertion::jitter,
                  "jitter",
                  "m",
                  at_least(0.0),
                  "each centre is moved at random by up to this along each axis")};
    }
};

/// Spheres listed one by one.
struct Placement {
    std::string species;
    Vec3 position{};
    Vec3 velocity{};
    Vec3 angular_velocity{};

    static constexpr auto fields() {
        return std::tuple{
            required(&Placement::species, "species", "", any_number(), "name of the species"),
            required(&Placement::position, "position", "m", any_number(), "centre"),
            field(&Placement::velocity, "velocity", "m/s", any_number(), "initial velocity"),
            field(&Placement::angular_velocity,
                  "angular_velocity",
                  "rad/s",
                  any_number(),
                  "initial spin")};
    }
};

struct ListInsertion {
    static constexpr std::string_view key = "list";
    std::vector<Placement> particles;

    static constexpr auto fields() {
        return std::tuple{required(
            &ListInsertion::particles, "particles", "", any_number(), "the spheres, one by one")};
    }
};

/// Spheres from a CSV (columns x,y,z[,radius][,vx,vy,vz][,wx,wy,wz][,species]) or VTP file. A
/// radius column overrides the radius of the species. io fills `imported` before the scene is
/// built.
struct FileInsertion {
    static constexpr std::string_view key = "file";
    std::string path;
    std::string species;

    static constexpr auto fields() {
        return std::tuple{required(&FileInsertion::path,
                                   "path",
                                   "",
                                   any_number(),
                                   "CSV or VTP file, relative to the scene"),
                          required(&FileInsertion::species,
                                   "species",
                                   "",
                                   any_number(),
                                   "species of all rows that name none")};
    }

    /// One sphere as read; not part of the JSON.
    struct Row {
        std::string species;
        Vec3 position{};
        Vec3 velocity{};
        Vec3 angular_velocity{};
        double radius = 0.0;
    };

    std::vector<Row> imported;
};

using Insertion = std::variant<RandomInsertion, LatticeInsertion, ListInsertion, FileInsertion>;

enum class Axis { x, y, z };

template <>
struct EnumNames<Axis> {
    static constexpr std::array<std::pair<Axis, std::string_view>, 3> value{
        {{Axis::x, "x"}, {Axis::y, "y"}, {Axis::z, "z"}}};
};

/// Deletes, after insertion, the spheres whose centre lies in the interval (low, high) of one axis.
struct Removal {
    Axis axis = Axis::z;
    double low = -1e300;
    double high = 1e300;

    static constexpr auto fields() {
        return std::tuple{
            field(&Removal::axis, "axis", "", any_number(), "axis of the interval"),
            field(&Removal::low, "low", "m", any_number(), "lower end of the interval"),
            field(&Removal::high, "high", "m", any_number(), "upper end of the interval")};
    }
};

struct Particles {
    std::vector<Species> species;
    std::vector<Insertion> insertion;
    std::vector<Removal> removal;

    static constexpr auto fields() {
        return std::tuple{
            required(&Particles::species, "species", "", any_number(), "kinds of spheres"),
            field(&Particles::insertion,
                  "insertion",
                  "",
                  any_number(),
                  "how spheres come into the scene, in this order"),
            field(&Particles::removal,
                  "removal",
                  "",
                  any_number(),
                  "slices deleted after insertion")};
    }
};

// --- walls ---------------------------------------------------------------------------------------

/// A rigid body of infinite mass: one shape, one motion.
struct Wall {
    std::string name;
    WallShape shape;
    WallMotion motion;
    std::optional<std::string> material;

    static constexpr auto fields() {
        return std::tuple{
            required(&Wall::name, "name", "", any_number(), "name, unique among walls"),
            required(&Wall::shape, "shape", "", any_number(), "geometry"),
            field(&Wall::motion, "motion", "", any_number(), "motion from the first stage on"),
            field(&Wall::material,
                  "material",
                  "",
                  any_number(),
                  "name used in contact.pairs; the wall's name if absent")};
    }

    const std::string& material_name() const { return material ? *material : name; }
};

// --- contact -------------------------------------------------------------------------------------

using StiffnessLaw =
    std::variant<ConstantStiffness::Params, DeformabilityStiffness::Params, HertzStiffness::Params>;
using NormalLaw = std::variant<LinearSpring::Params,
                               IncrementalSpring::Params,
                               HertzSpring::Params,
                               JkrAdhesion::Params,
                               WaltonBraunSpring::Params>;
using FrictionLaw = std::variant<CoulombFriction::Params, MindlinFriction::Params>;
using DampingLaw = std::variant<ViscousDamping::Params, RestitutionDamping::Params>;
using CohesionLaw = std::variant<LinearCohesion::Params>;
using RollingLaw = std::variant<RollingResistance::Params>;
using TwistingLaw = std::variant<TwistingResistance::Params>;

/// Other numbers for one pair of materials (species or wall materials). The laws themselves are the
/// scene's: a pair can change numbers of a law that is on, not turn a law on.
struct PairContact {
    std::vector<std::string> between;
    std::optional<StiffnessLaw> stiffness;
    std::optional<NormalLaw> normal;
    std::optional<FrictionLaw> friction;
    std::optional<DampingLaw> damping;
    std::optional<CohesionLaw> cohesion;
    std::optional<RollingLaw> rolling;
    std::optional<TwistingLaw> twisting;

    static constexpr auto fields() {
        return std::tuple{
            required(&PairContact::between,
                     "between",
                     "",
                     any_number(),
                     "two names: species or wall materials"),
            field(&PairContact::stiffness, "stiffness", "", any_number(), "stiffness of this pair"),
            field(&PairContact::normal, "normal", "", any_number(), "normal spring of this pair"),
            field(&PairContact::friction, "friction", "", any_number(), "friction of this pair"),
            field(&PairContact::damping, "damping", "", any_number(), "damping of this pair"),
            field(&PairContact::cohesion, "cohesion", "", any_number(), "cohesion of this pair"),
            field(&PairContact::rolling,
                  "rolling",
                  "",
                  any_number(),
                  "rolling resistance of this pair"),
            field(&PairContact::twisting,
                  "twisting",
                  "",
                  any_number(),
                  "twisting resistance of this pair")};
    }
};

/// Laws of all contacts. An absent optional law is off and costs nothing.
struct Contact {
    StiffnessLaw stiffness;
    NormalLaw normal;
    std::optional<FrictionLaw> friction;
    std::optional<DampingLaw> damping;
    std::optional<CohesionLaw> cohesion;
    std::optional<RollingLaw> rolling;
    std::optional<TwistingLaw> twisting;
    std::vector<PairContact> pairs;

    static constexpr auto fields() {
        return std::tuple{
            required(&Contact::stiffness, "stiffness", "", any_number(), "stiffness of contacts"),
            required(&Contact::normal, "normal", "", any_number(), "normal spring"),
            field(&Contact::friction,
                  "friction",
                  "",
                  any_number(),
                  "friction; absent = frictionless"),
            field(&Contact::damping, "damping", "", any_number(), "dashpots; absent = undamped"),
            field(&Contact::cohesion,
                  "cohesion",
                  "",
                  any_number(),
                  "attraction; absent = cohesionless"),
            field(&Contact::rolling,
                  "rolling",
                  "",
                  any_number(),
                  "moment against rolling; absent = none"),
            field(&Contact::twisting,
                  "twisting",
                  "",
                  any_number(),
                  "moment against spin about the normal; absent = none"),
            field(&Contact::pairs, "pairs", "", any_number(), "other numbers for named pairs")};
    }
};

// --- timestep and detection ----------------------------------------------------------------------

/// dt = min(safety_factor * stable step, kinematic limit, maximum), grown by at most `growth` a
/// cycle.
struct AutomaticTimestep {
    static constexpr std::string_view key = "automatic";
    double safety_factor = 0.8;
    double growth = 1.05;
    std::optional<double> maximum;

    static constexpr auto fields() {
        return std::tuple{
            field(&AutomaticTimestep::safety_factor,
                  "safety_factor",
                  "1",
                  positive(),
                  "fraction of the estimated stable step"),
            field(&AutomaticTimestep::growth,
                  "growth",
                  "1",
                  Domain{.low = 1.0, .low_open = true},
                  "largest growth factor from one cycle to the next"),
            field(&AutomaticTimestep::maximum, "maximum", "s", positive(), "upper bound")};
    }
};

struct FixedTimestep {
    static constexpr std::string_view key = "fixed";
    double value = 0.0;

    static constexpr auto fields() {
        return std::tuple{required(&FixedTimestep::value, "value", "s", positive(), "the step")};
    }
};

/// Inertial masses are scaled so that the stable step of every particle is `value`; gravity uses
/// the real mass. Time has no meaning: for quasi-static states only.
struct ScaledTimestep {
    static constexpr std::string_view key = "scaled";
    double value = 1.0;
    double safety_factor = 0.8;

    static constexpr auto fields() {
        return std::tuple{field(&ScaledTimestep::value, "value", "s", positive(), "the step"),
                          field(&ScaledTimestep::safety_factor,
                                "safety_factor",
                                "1",
                                positive(),
                                "fraction of the estimated stable step")};
    }
};

using Timestep = std::variant<AutomaticTimestep, FixedTimestep, ScaledTimestep>;

/// Contacts are looked for when a particle has moved by its tolerance relative to the bed.
struct DisplacementTrigger {
    static constexpr std::string_view key = "displacement";

    static constexpr auto fields() { return std::tuple{}; }
};

/// Contacts are looked for every `interval` cycles, whatever moved: cheaper, may find contacts
/// late.
struct RemapInterval {
    static constexpr std::string_view key = "interval";
    std::int64_t cycles = 10;

    static constexpr auto fields() {
        return std::tuple{required(
            &RemapInterval::cycles, "cycles", "1", at_least(1), "cycles between two searches")};
    }
};

using DetectionTrigger = std::variant<DisplacementTrigger, RemapInterval>;

struct Detection {
    DetectionTrigger trigger;
    double tolerance = 0.0625;
    bool create_on_overlap = false;

    static constexpr auto fields() {
        return std::tuple{
            field(&Detection::trigger, "trigger", "", any_number(), "when contacts are looked for"),
            field(
                &Detection::tolerance,
                "tolerance",
                "1",
                positive(),
                "detection tolerance of a particle over its radius: contacts exist within the sum"),
            field(&Detection::create_on_overlap,
                  "create_on_overlap",
                  "",
                  any_number(),
                  "contacts exist only while surfaces overlap")};
    }
};

// --- what is measured and written ----------------------------------------------------------------

/// A named set of particles, fixed after insertion.
struct Group {
    std::string name;
    std::optional<std::string> species;
    std::optional<Box> box;

    static constexpr auto fields() {
        return std::tuple{
            required(&Group::name, "name", "", any_number(), "name, unique among groups"),
            field(&Group::species, "species", "", any_number(), "only this species"),
            field(&Group::box, "box", "m", any_number(), "only centres in this box at the start")};
    }
};

/// Numbers 1, 2, ... by the position along an axis after insertion, 0 outside all layers.
struct Layers {
    Axis axis = Axis::z;
    std::vector<double> edges;
    std::int64_t relayer_count = 8;

    static constexpr auto fields() {
        return std::tuple{
            field(&Layers::axis, "axis", "", any_number(), "axis of the layers"),
            required(&Layers::edges,
                     "edges",
                     "m",
                     any_number(),
                     "edges from the first layer to the last, descending or ascending"),
            field(&Layers::relayer_count,
                  "relayer_count",
                  "1",
                  at_least(1),
                  "equal layers between the lowest and the highest centre, 1 on top, assigned anew "
                  "in "
                  "each frame as the array current_layer")};
    }
};

/// Mean height of one group over another, as the example's intruder elevation, in metres.
struct ElevationObservable {
    std::string upper;
    std::string lower;
    std::int64_t sample_cycles = 10;
    double average_interval = 0.1;

    static constexpr auto fields() {
        return std::tuple{required(&ElevationObservable::upper,
                                   "upper",
                                   "",
                                   any_number(),
                                   "group whose mean height is taken"),
                          required(&ElevationObservable::lower,
                                   "lower",
                                   "",
                                   any_number(),
                                   "group whose mean height is subtracted"),
                          field(&ElevationObservable::sample_cycles,
                                "sample_cycles",
                                "1",
                                at_least(1),
                                "cycles between two samples"),
                          field(&ElevationObservable::average_interval,
                                "average_interval",
                                "s",
                                positive(),
                                "interval of the running average; a stage may change it")};
    }
};

/// Ledger of all energies. Costs a pass over the touching contacts; absent = nothing is summed.
struct EnergyObservable {
    static constexpr auto fields() { return std::tuple{}; }
};

/// Force and torque on each wall, as columns of the history.
struct WallForceObservable {
    static constexpr auto fields() { return std::tuple{}; }
};

struct Observables {
    std::optional<ElevationObservable> elevation;
    std::optional<EnergyObservable> energy;
    std::optional<WallForceObservable> wall_forces;

    static constexpr auto fields() {
        return std::tuple{field(&Observables::elevation,
                                "elevation",
                                "",
                                any_number(),
                                "mean height of one group over another, with entrainment time"),
                          field(&Observables::energy, "energy", "", any_number(), "energy ledger"),
                          field(&Observables::wall_forces,
                                "wall_forces",
                                "",
                                any_number(),
                                "force and torque on each wall")};
    }
};

/// Path of the particle that is nearest to a point at the start.
struct Trace {
    Vec3 nearest_to{};
    std::optional<std::string> species;

    static constexpr auto fields() {
        return std::tuple{
            required(&Trace::nearest_to, "nearest_to", "m", any_number(), "point at the start"),
            field(&Trace::species, "species", "", any_number(), "only this species")};
    }
};

/// Independent copies of the scene that differ in their random numbers.
struct Realisations {
    std::int64_t count = 1;
    std::int64_t seed = 10001;

    static constexpr auto fields() {
        return std::tuple{
            field(&Realisations::count, "count", "1", between(1, 10000), "number of copies"),
            field(&Realisations::seed,
                  "seed",
                  "",
                  at_least(0),
                  "seed of the first; the others count up from it")};
    }
};

/// When files are written. An absent interval means never (but the end of the run is always
/// written).
struct Output {
    std::optional<double> frame_interval;
    std::optional<double> history_interval;
    std::optional<std::int64_t> history_cycles;
    std::optional<double> trace_interval;
    std::optional<double> checkpoint_interval;
    bool contacts = false;

    static constexpr auto fields() {
        return std::tuple{field(&Output::frame_interval,
                                "frame_interval",
                                "s",
                                positive(),
                                "time between frames (particles, walls)"),
                          field(&Output::history_interval,
                                "history_interval",
                                "s",
                                positive(),
                                "time between rows of the history"),
                          field(&Output::history_cycles,
                                "history_cycles",
                                "1",
                                at_least(1),
                                "cycles between rows of the history; instead of history_interval"),
                          field(&Output::trace_interval,
                                "trace_interval",
                                "s",
                                positive(),
                                "time between points of a trace"),
                          field(&Output::checkpoint_interval,
                                "checkpoint_interval",
                                "s",
                                positive(),
                                "simulated time between checkpoints"),
                          field(&Output::contacts,
                                "contacts",
                                "",
                                any_number(),
                                "write the contact network with each frame")};
    }
};

// --- stages --------------------------------------------------------------------------------------

struct StageMotion {
    std::string wall;
    WallMotion motion;

    static constexpr auto fields() {
        return std::tuple{
            required(&StageMotion::wall, "wall", "", any_number(), "name of the wall"),
            required(&StageMotion::motion,
                     "motion",
                     "",
                     any_number(),
                     "motion from the start of this stage on")};
    }
};

struct Stage {
    std::string name;
    double duration = 0.0;
    std::vector<StageMotion> motions;
    std::optional<Vec3> gravity;
    std::optional<Contact> contact;
    std::optional<Timestep> timestep;
    std::optional<Output> output;
    std::optional<double> average_interval;

    static constexpr auto fields() {
        return std::tuple{
            field(&Stage::name, "name", "", any_number(), "name for logs and histories"),
            required(&Stage::duration, "duration", "s", at_least(0.0), "simulated time"),
            field(&Stage::motions, "motions", "", any_number(), "walls whose motion changes"),
            field(&Stage::gravity,
                  "gravity",
                  "m/s^2",
                  any_number(),
                  "acceleration from here on: another direction tilts the whole scene"),
            field(&Stage::contact, "contact", "", any_number(), "contact laws from here on"),
            field(&Stage::timestep, "timestep", "", any_number(), "timestep scheme from here on"),
            field(&Stage::output, "output", "", any_number(), "output intervals from here on"),
            field(&Stage::average_interval,
                  "average_interval",
                  "s",
                  positive(),
                  "averaging interval of the elevation from here on")};
    }
};

// --- scene ---------------------------------------------------------------------------------------

struct Scene {
    static constexpr std::string_view format_name = "grainbench-scene/1";

    std::string schema;
    std::string format{format_name};
    std::string title;
    std::string description;
    std::optional<Vec3> gravity;
    Particles particles;
    std::vector<Wall> walls;
    Contact contact;
    Timestep timestep;
    Detection detection;
    std::vector<Stage> stages;
    std::vector<Group> groups;
    std::optional<Layers> layers;
    Observables observables;
    std::vector<Trace> traces;
    Realisations realisations;
    Guards guards;
    Output output;

    static constexpr auto fields() {
        return std::tuple{
            field(&Scene::schema, "$schema", "", any_number(), "schema for editors; not read"),
            required(&Scene::format, "format", "", any_number(), "\"grainbench-scene/1\""),
            field(&Scene::title, "title", "", any_number(), "one line"),
            field(&Scene::description, "description", "", any_number(), "what the scene shows"),
            field(&Scene::gravity, "gravity", "m/s^2", any_number(), "acceleration; absent = none"),
            required(&Scene::particles, "particles", "", any_number(), "species and insertion"),
            field(&Scene::walls, "walls", "", any_number(), "rigid bodies of infinite mass"),
            required(&Scene::contact, "contact", "", any_number(), "contact laws"),
            field(&Scene::timestep, "timestep", "", any_number(), "how the step is chosen"),
            field(&Scene::detection, "detection", "", any_number(), "how contacts are found"),
            required(&Scene::stages, "stages", "", any_number(), "what happens, in this order"),
            field(&Scene::groups, "groups", "", any_number(), "named sets of particles"),
            field(&Scene::layers, "layers", "", any_number(), "numbered slices"),
            field(&Scene::observables, "observables", "", any_number(), "what is measured"),
            field(&Scene::traces, "traces", "", any_number(), "particles whose path is recorded"),
            field(
                &Scene::realisations, "realisations", "", any_number(), "copies with other seeds"),
            field(&Scene::guards, "guards", "", any_number(), "what stops a run, or is warned of"),
            field(&Scene::output, "output", "", any_number(), "when files are written")};
    }
};

}  // namespace grainbench
