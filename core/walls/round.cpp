#include "core/walls/round.hpp"

#include "core/describe.hpp"
#include "core/walls/faceted.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace grainbench {

namespace {

Plate make_plate(const Vec3& centre, const Vec3& normal, double radius, Index rim) {
    return {.centre = centre,
            .normal = normal,
            .offset = dot(normal, centre),
            .radius = radius,
            .rim = rim};
}

constexpr Index base_rim = 0;
constexpr Index top_rim = 1;

/// Corners that stand for a circle in frames.
constexpr Index drawn_corners = 64;

bool has_side(CylinderPart part) {
    return part == CylinderPart::all || part == CylinderPart::side ||
           part == CylinderPart::open_top;
}

bool has_base(CylinderPart part) {
    return part != CylinderPart::side;
}

bool has_top(CylinderPart part) {
    return part == CylinderPart::all || part == CylinderPart::caps;
}

void add_circle(WallSurface& outline, const Vec3& centre, const Vec3& axis, double radius) {
    const AxisFrame frame = frame_about(axis);
    for (Index k = 0; k < drawn_corners; ++k) {
        const double angle = 2.0 * pi * k / drawn_corners;
        outline.points.push_back(centre +
                                 radius * (std::cos(angle) * frame.u + std::sin(angle) * frame.v));
    }
}

double circle_extent(const Vec3& centre, const Vec3& axis, double radius, const Vec3& point) {
    const Vec3 from = point - centre;
    const double height = dot(axis, from);
    return std::hypot(height, norm(from - height * axis) + radius);
}

}  // namespace

std::vector<RoundPatch> round_patches(const Plane& plane) {
    return {
        make_plate(plane.point, plane.normal, std::numeric_limits<double>::infinity(), no_feature)};
}

std::vector<RoundPatch> round_patches(const Disc& disc) {
    Plate plate = make_plate(disc.centre, disc.normal, disc.radius, base_rim);
    if (disc.hole > 0.0) {
        plate.hole = disc.hole;
        plate.any_radial = frame_about(disc.normal).u;
        plate.hole_rim = top_rim;
    }
    return {plate};
}

std::vector<RoundPatch> round_patches(const Cylinder& c) {
    std::vector<RoundPatch> patches;
    if (has_side(c.part)) {
        patches.emplace_back(
            Shell{c.base, c.axis, frame_about(c.axis).u, c.radius, c.height, {base_rim, top_rim}});
    }
    if (has_base(c.part)) {
        patches.emplace_back(make_plate(c.base, -c.axis, c.radius, base_rim));
    }
    if (has_top(c.part)) {
        patches.emplace_back(make_plate(c.base + c.height * c.axis, c.axis, c.radius, top_rim));
    }
    return patches;
}

WallSurface round_outline(const Plane& plane) {
    const AxisFrame frame = frame_about(plane.normal);
    const double half = 0.5 * plane.view_size;
    WallSurface outline;
    for (const auto& [u, v] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
        outline.points.push_back(plane.point + half * (static_cast<double>(u) * frame.u +
                                                       static_cast<double>(v) * frame.v));
    }
    outline.polygons = {{0, 1, 2, 3}};
    return outline;
}

WallSurface round_outline(const Disc& disc) {
    WallSurface outline;
    add_circle(outline, disc.centre, disc.normal, disc.radius);
    if (disc.hole > 0.0) {
        add_circle(outline, disc.centre, disc.normal, disc.hole);
        for (Index k = 0; k < drawn_corners; ++k) {
            const Index next = (k + 1) % drawn_corners;
            outline.polygons.push_back({k, next, drawn_corners + next, drawn_corners + k});
        }
        return outline;
    }
    outline.polygons.emplace_back(drawn_corners);
    std::iota(outline.polygons[0].begin(), outline.polygons[0].end(), Index{0});
    return outline;
}

WallSurface round_outline(const Cylinder& c) {
    WallSurface outline;
    add_circle(outline, c.base, c.axis, c.radius);
    if (has_side(c.part) || has_top(c.part)) {
        add_circle(outline, c.base + c.height * c.axis, c.axis, c.radius);
    }
    for (Index k = 0; has_side(c.part) && k < drawn_corners; ++k) {
        const Index next = (k + 1) % drawn_corners;
        outline.polygons.push_back({k, next, drawn_corners + next, drawn_corners + k});
    }
    std::vector<Index> cap(drawn_corners);
    if (has_base(c.part)) {
        std::iota(cap.rbegin(), cap.rend(), Index{0});
        outline.polygons.push_back(cap);
    }
    if (has_top(c.part)) {
        std::iota(cap.begin(), cap.end(), drawn_corners);
        outline.polygons.push_back(cap);
    }
    return outline;
}

double extent_of(const RoundPatch& patch, const Vec3& point) {
    return std::visit(
        Overloaded{
            [&](const Plate& p) { return circle_extent(p.centre, p.normal, p.radius, point); },
            [&](const Shell& s) {
                return std::max(circle_extent(s.base, s.axis, s.radius, point),
                                circle_extent(s.base + s.height * s.axis, s.axis, s.radius, point));
            }},
        patch);
}

bool cylinder_encloses(const Cylinder& c, const Vec3& centre, double radius) {
    const Vec3 from = centre - c.base;
    const double along = dot(c.axis, from);
    return along >= radius && c.height - along >= radius &&
           c.radius - norm(from - along * c.axis) >= radius;
}

}  // namespace grainbench
