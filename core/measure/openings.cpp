#include "core/measure/openings.hpp"

#include <algorithm>
#include <limits>

namespace grainbench {
namespace {

constexpr double no_opening = std::numeric_limits<double>::infinity();

/// The narrowest way across [m].
double width_of(const WallShape& shape) {
    return std::visit(Overloaded{[](const Cylinder& c) { return 2.0 * c.radius; },
                                 [](const FacetedCylinder& c) { return 2.0 * c.radius; },
                                 [](const BoxShape& b) {
                                     const Vec3 size = b.high - b.low;
                                     return std::min({size.x, size.y, size.z});
                                 },
                                 [](const auto&) { return no_opening; }},
                      shape);
}

bool is_inserted(const Scene& scene, const std::string& species) {
    return std::any_of(
        scene.particles.insertion.begin(),
        scene.particles.insertion.end(),
        [&](const Insertion& insertion) {
            return std::visit(
                Overloaded{[&](const RandomInsertion& i) { return i.species == species; },
                           [&](const LatticeInsertion& i) { return i.species == species; },
                           [](const auto&) { return true; }},
                insertion);
        });
}

}  // namespace

std::vector<NarrowOpening> narrow_openings(const Scene& scene) {
    std::vector<NarrowOpening> found;
    for (const Wall& wall : scene.walls) {
        const double width = width_of(wall.shape);
        for (const Species& species : scene.particles.species) {
            const double diameters = width / (2.0 * species.radius);
            if (diameters < fewest_diameters && is_inserted(scene, species.name)) {
                found.push_back({wall.name, species.name, diameters});
            }
        }
    }
    return found;
}

}  // namespace grainbench
