/// What a scene measures: groups, layers, observables, traces. SI units.
#pragma once

#include "core/box.hpp"
#include "core/describe.hpp"
#include "core/scene/particles.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace grainbench {

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

}  // namespace grainbench
