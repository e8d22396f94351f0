/// A box in space, as scenes name regions.
#pragma once

#include "core/describe.hpp"
#include "core/types.hpp"

namespace grainbench {

/// Axis-aligned box from low to high.
struct Box {
    Vec3 low{};
    Vec3 high{};

    static constexpr auto fields() {
        return std::tuple{
            required(&Box::low, "low", "m", any_number(), "corner with the smallest coordinates"),
            required(&Box::high, "high", "m", any_number(), "corner with the largest coordinates")};
    }
};

}  // namespace grainbench
