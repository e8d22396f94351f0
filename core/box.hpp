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

/// Whether a point lies in a box or on its faces.
inline bool holds(const Box& box, const Vec3& p) {
    return p.x >= box.low.x && p.y >= box.low.y && p.z >= box.low.z && p.x <= box.high.x &&
           p.y <= box.high.y && p.z <= box.high.z;
}

}  // namespace grainbench
