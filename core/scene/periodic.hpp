/// Directions in which a scene repeats itself. SI units.
#pragma once

#include "core/describe.hpp"

#include <optional>

namespace grainbench {

struct Interval {
    double low = 0.0;
    double high = 0.0;

    static constexpr auto fields() {
        return std::tuple{required(&Interval::low, "low", "m", any_number(), "lower end"),
                          required(&Interval::high, "high", "m", any_number(), "upper end")};
    }
};

/// What leaves such an interval at one end comes back at the other; contacts reach across.
struct Periodic {
    std::optional<Interval> x;
    std::optional<Interval> y;
    std::optional<Interval> z;

    static constexpr auto fields() {
        return std::tuple{field(&Periodic::x, "x", "", any_number(), "interval along x"),
                          field(&Periodic::y, "y", "", any_number(), "interval along y"),
                          field(&Periodic::z, "z", "", any_number(), "interval along z")};
    }
};

}  // namespace grainbench
