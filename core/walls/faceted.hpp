/// Shapes turned into triangles.
#pragma once

#include "core/types.hpp"
#include "core/walls/shapes.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace grainbench {

struct IndexedTriangles {
    std::vector<Vec3> points;  ///< [m]
    std::vector<std::array<Index, 3>> triangles;
};

/// Right-handed frame of unit vectors whose third is the axis; u is x where the axis is z.
struct AxisFrame {
    Vec3 u, v, axis;
};

AxisFrame frame_about(const Vec3& unit_axis);

/// Number of edges of an end circle: the fewest that are shorter than resolution * radius.
std::int64_t circle_edges(double resolution);

/// 12 triangles, wound outward.
IndexedTriangles box_triangles(const BoxShape& box);

/// Two triangles for each facet of the side, caps as fans about their centres, wound outward.
/// \param shape axis of unit length
IndexedTriangles cylinder_triangles(const FacetedCylinder& shape);

/// Triangles as the scene gives them; `where` names the wall in errors.
IndexedTriangles listed_triangles(const Triangles& shape, const std::string& where);

}  // namespace grainbench
