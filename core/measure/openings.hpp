/// Walls that leave room for a few particles only. With fewer than eight diameters across, layers
/// along the walls and arches between them decide what flows, and larger particles in place of the
/// real ones no longer stand for them.
#pragma once

#include "core/scene.hpp"

#include <string>
#include <vector>

namespace grainbench {

struct NarrowOpening {
    std::string wall;
    std::string species;
    double diameters = 0.0;  ///< [1] of the species across the wall's narrowest way
};

inline constexpr double fewest_diameters = 8.0;

/// Of cylinders and boxes; other shapes are not looked at. Only species that are inserted count.
std::vector<NarrowOpening> narrow_openings(const Scene& scene);

}  // namespace grainbench
