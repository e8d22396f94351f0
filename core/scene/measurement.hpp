/// Which particles a scene names: groups, layers, traces. What it measures of them is in
/// core/scene/observables.hpp. SI units.
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
