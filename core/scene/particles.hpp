/// Which spheres a scene holds and how they come into it. SI units.
#pragma once

#include "core/box.hpp"
#include "core/describe.hpp"
#include "core/types.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace grainbench {

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

/// Deletes and counts, while the scene runs, the spheres whose centre lies in the interval (low,
/// high) of one axis, and in the box if there is one.
struct Sink {
    std::string name;
    Axis axis = Axis::z;
    double low = -1e300;
    double high = 1e300;
    std::optional<Box> box;

    static constexpr auto fields() {
        return std::tuple{
            required(&Sink::name, "name", "", any_number(), "name, unique among sinks"),
            field(&Sink::axis, "axis", "", any_number(), "axis of the interval"),
            field(&Sink::low, "low", "m", any_number(), "lower end of the interval"),
            field(&Sink::high, "high", "m", any_number(), "upper end of the interval"),
            field(&Sink::box, "box", "m", any_number(), "only centres in this box as well")};
    }
};

/// Lets spheres in while the scene runs, at random places of a box where nothing is in their way.
/// What finds no room waits.
struct Source {
    std::string name;
    std::string species;
    Box box;
    double rate = 0.0;
    std::optional<std::int64_t> count;
    Vec3 velocity{};
    double start = 0.0;
    std::optional<double> end;
    std::int64_t tries = 100;

    static constexpr auto fields() {
        return std::tuple{
            required(&Source::name, "name", "", any_number(), "name, unique among sources"),
            required(&Source::species, "species", "", any_number(), "name of the species"),
            required(&Source::box,
                     "box",
                     "m",
                     any_number(),
                     "box that bounds the surfaces of the spheres"),
            required(&Source::rate, "rate", "1/s", positive(), "spheres per second"),
            field(&Source::count, "count", "1", at_least(1), "most spheres in all"),
            field(&Source::velocity, "velocity", "m/s", any_number(), "velocity at the start"),
            field(&Source::start, "start", "s", at_least(0.0), "time of the first sphere"),
            field(&Source::end, "end", "s", positive(), "time after which none come"),
            field(&Source::tries,
                  "tries",
                  "1",
                  at_least(1),
                  "placement attempts for each sphere that is due, at each look")};
    }
};

struct Particles {
    std::vector<Species> species;
    std::vector<Insertion> insertion;
    std::vector<Removal> removal;
    std::vector<Source> sources;
    std::vector<Sink> sinks;

    static constexpr auto fields() {
        return std::tuple{
            required(&Particles::species, "species", "", any_number(), "kinds of spheres"),
            field(&Particles::insertion,
                  "insertion",
                  "",
                  any_number(),
                  "how spheres come into the scene, in this order"),
            field(
                &Particles::removal, "removal", "", any_number(), "slices deleted after insertion"),
            field(&Particles::sources,
                  "sources",
                  "",
                  any_number(),
                  "what comes in while the scene runs"),
            field(&Particles::sinks,
                  "sinks",
                  "",
                  any_number(),
                  "what is deleted while the scene runs")};
    }
};

}  // namespace grainbench
