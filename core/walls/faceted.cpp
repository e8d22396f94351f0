#include "core/walls/faceted.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace grainbench {

AxisFrame frame_about(const Vec3& unit_axis) {
    // The coordinate direction that is least along the axis leaves the most after projection.
    const Vec3 size{std::abs(unit_axis.x), std::abs(unit_axis.y), std::abs(unit_axis.z)};
    const Vec3 helper = size.x <= size.y && size.x <= size.z ? Vec3{1.0, 0.0, 0.0}
                        : size.y <= size.z                   ? Vec3{0.0, 1.0, 0.0}
                                                             : Vec3{0.0, 0.0, 1.0};
    const Vec3 u = normalized(helper - dot(helper, unit_axis) * unit_axis);
    return {u, cross(unit_axis, u), unit_axis};
}

std::int64_t circle_edges(double resolution) {
    // Chords are at most two radii long: coarser than that, a triangle is the coarsest circle.
    const double guess = pi / std::asin(std::min(0.5 * resolution, 1.0));
    std::int64_t n = std::max<std::int64_t>(3, static_cast<std::int64_t>(guess) - 1);
    while (2.0 * std::sin(pi / static_cast<double>(n)) >= resolution) {
        ++n;
    }
    return n;
}

IndexedTriangles box_triangles(const BoxShape& box) {
    IndexedTriangles out;
    for (unsigned k = 0; k < 8; ++k) {
        out.points.push_back({k & 1U ? box.high.x : box.low.x,
                              k & 2U ? box.high.y : box.low.y,
                              k & 4U ? box.high.z : box.low.z});
    }
    // Corners of each face, counter-clockwise seen from outside; bit 0, 1, 2 of a corner: high x,
    // y, z.
    constexpr std::array<std::array<Index, 4>, 6> faces{
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    for (const auto& [a, b, c, d] : faces) {
        out.triangles.push_back({a, b, c});
        out.triangles.push_back({a, c, d});
    }
    return out;
}

IndexedTriangles cylinder_triangles(const FacetedCylinder& shape) {
    const auto n = static_cast<Index>(circle_edges(shape.resolution));
    const AxisFrame frame = frame_about(shape.axis);
    const Vec3 rise = shape.height * frame.axis;
    const bool has_side = shape.part == CylinderPart::all || shape.part == CylinderPart::side ||
                          shape.part == CylinderPart::open_top;
    const bool has_base = shape.part != CylinderPart::side;
    const bool has_top = shape.part == CylinderPart::all || shape.part == CylinderPart::caps;

    IndexedTriangles out;
    for (const Vec3& centre : {shape.base, shape.base + rise}) {
        for (Index k = 0; k < n; ++k) {
            const double angle = 2.0 * pi * k / n;
            out.points.push_back(
                centre + shape.radius * (std::cos(angle) * frame.u + std::sin(angle) * frame.v));
        }
    }
    const Index base_centre = 2 * n;
    const Index top_centre = base_centre + 1;
    out.points.push_back(shape.base);
    out.points.push_back(shape.base + rise);

    for (Index k = 0; has_side && k < n; ++k) {
        const Index next = (k + 1) % n;
        out.triangles.push_back({k, next, n + next});
        out.triangles.push_back({k, n + next, n + k});
    }
    for (Index k = 0; has_base && k < n; ++k) {
        out.triangles.push_back({base_centre, (k + 1) % n, k});
    }
    for (Index k = 0; has_top && k < n; ++k) {
        out.triangles.push_back({top_centre, n + k, n + (k + 1) % n});
    }
    return out;
}

IndexedTriangles listed_triangles(const Triangles& shape, const std::string& where) {
    IndexedTriangles out{shape.vertices, {}};
    const auto count = static_cast<std::int64_t>(shape.vertices.size());
    for (std::size_t k = 0; k < shape.triangles.size(); ++k) {
        const std::vector<std::int64_t>& given = shape.triangles[k];
        const bool usable =
            given.size() == 3 &&
            std::all_of(given.begin(), given.end(), [&](auto i) { return i >= 0 && i < count; });
        if (!usable) {
            throw_bad_input(
                {.what = "a triangle does not name three existing vertices",
                 .where = where + "/shape/triangles/" + std::to_string(k),
                 .likely_cause = "indices count from 0 and must be below " + std::to_string(count),
                 .next_step = "give three indices into vertices"});
        }
        out.triangles.push_back({static_cast<Index>(given[0]),
                                 static_cast<Index>(given[1]),
                                 static_cast<Index>(given[2])});
    }
    return out;
}

}  // namespace grainbench
