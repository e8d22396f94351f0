/// What tests of walls share: tolerances with a reason, random points, meshes to roll over.
#pragma once

#include "core/types.hpp"
#include "core/walls/shapes.hpp"
#include "core/walls/surface.hpp"

#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace grainbench {

/// n roundings of numbers of about this size.
inline double round_off(double n, double scale) {
    return n * std::numeric_limits<double>::epsilon() * scale;
}

class RandomPoints {
public:
    explicit RandomPoints(std::uint64_t seed) : generator_(seed) {}

    double between(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(generator_);
    }

    Vec3 in_cube(double half_edge) {
        const double x = between(-half_edge, half_edge);
        const double y = between(-half_edge, half_edge);
        return {x, y, between(-half_edge, half_edge)};
    }

private:
    std::mt19937_64 generator_;
};

/// Square of cells * cells cells of two triangles each, centred on the origin, at height(x, y).
template <class Height>
Triangles terrain(std::int64_t cells, double edge, const Height& height) {
    Triangles mesh;
    const std::int64_t row = cells + 1;
    for (std::int64_t j = 0; j < row; ++j) {
        for (std::int64_t i = 0; i < row; ++i) {
            const double x = edge * (static_cast<double>(i) / static_cast<double>(cells) - 0.5);
            const double y = edge * (static_cast<double>(j) / static_cast<double>(cells) - 0.5);
            mesh.vertices.push_back({x, y, height(x, y)});
        }
    }
    for (std::int64_t j = 0; j < cells; ++j) {
        for (std::int64_t i = 0; i < cells; ++i) {
            const std::int64_t a = j * row + i;
            mesh.triangles.push_back({a, a + 1, a + row + 1});
            mesh.triangles.push_back({a, a + row + 1, a + row});
        }
    }
    return mesh;
}

/// The container of the example: 13 edges, axis z, from z = -0.1 to 0.1.
inline FacetedCylinder example_container(CylinderPart part = CylinderPart::all) {
    return {
        .base = {0.0, 0.0, -0.1}, .radius = 0.05, .height = 0.2, .resolution = 0.5, .part = part};
}

inline std::vector<Index> patches_near(const Surface& surface, const Vec3& centre, double reach) {
    std::vector<Index> patches;
    surface.collect(centre, reach, patches);
    return patches;
}

inline std::vector<WallHit> hits_of(const Surface& surface, const Vec3& centre, double reach) {
    WallHits hits;
    surface.resolve(centre, reach, patches_near(surface, centre, reach), hits);
    return {hits.view().begin(), hits.view().end()};
}

}  // namespace grainbench
