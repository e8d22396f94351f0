/// Closest points on single patches. Header only: this is the inner loop of contacts with walls.
#pragma once

#include "core/types.hpp"
#include "core/walls/surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace grainbench {

/// No edge or vertex.
inline constexpr Index no_feature = std::numeric_limits<Index>::max();

/// The point of a patch that is closest to the centre of a sphere.
struct Closest {
    Vec3 point{};           ///< [m]
    Vec3 normal{};          ///< [1] from the centre to the point
    double distance = 0.0;  ///< [m]
    Feature feature = Feature::face;
    Index id = no_feature;  ///< number of the edge or vertex within the wall
};

/// Triangle with what the search for closest points needs more than once.
struct Triangle {
    std::array<Vec3, 3> corner;
    std::array<Vec3, 3> side;                   ///< [m] from corner k to corner k + 1
    std::array<Vec3, 3> inward;                 ///< [1] in the plane, at right angles to side k
    std::array<double, 3> inverse_square_side;  ///< [1/m^2]
    Vec3 normal;                                ///< [1] right-handed
    double offset;                              ///< [m] of the plane: normal . corner
    std::array<Index, 3> vertex;                ///< numbers within the wall
    std::array<Index, 3> edge;                  ///< edge k lies on side k
};

/// Flat round plate (finite radius) or plane (infinite radius), with or without a hole. Rims are
/// edges.
struct Plate {
    Vec3 centre;
    Vec3 normal;    ///< [1]
    double offset;  ///< [m] of the plane: normal . centre
    double radius;
    Index rim;
    double hole = 0.0;  ///< [m] radius
    Vec3 any_radial{};  ///< [1] used for centres on the axis of a hole
    Index hole_rim = no_feature;
};

/// Round shell between base and base + height * axis.
struct Shell {
    Vec3 base;
    Vec3 axis;        ///< [1]
    Vec3 any_radial;  ///< [1] used for centres on the axis, where all directions are equally close
    double radius;
    double height;
    std::array<Index, 2> rim;  ///< at the base, at the top
};

namespace detail {

/// Normal of a face for a centre at `height` over it; the face's own if the centre lies in it.
inline Vec3 towards_face(const Vec3& normal, double height) {
    return height > 0.0 ? -normal : normal;
}

/// Contact with an edge or vertex at `offset` from the centre; false if farther than reach.
inline bool set_rim(const Vec3& centre,
                    const Vec3& offset,
                    double reach,
                    const Vec3& normal_at_zero,
                    Closest& out) {
    const double squared = dot(offset, offset);
    if (squared > reach * reach) {
        return false;
    }
    out.distance = std::sqrt(squared);
    out.point = centre + offset;
    out.normal = out.distance > 0.0 ? (1.0 / out.distance) * offset : normal_at_zero;
    return true;
}

}  // namespace detail

/// True if the triangle has that edge or vertex.
inline bool has_feature(const Triangle& t, Feature feature, Index id) {
    const auto& ids = feature == Feature::edge ? t.edge : t.vertex;
    return ids[0] == id || ids[1] == id || ids[2] == id;
}

inline bool has_feature(const Plate& plate, Feature feature, Index id) {
    return feature == Feature::edge && (plate.rim == id || plate.hole_rim == id);
}

inline bool has_feature(const Shell& shell, Feature feature, Index id) {
    return feature == Feature::edge && (shell.rim[0] == id || shell.rim[1] == id);
}

/// For centres outside the sides where `inside` is not positive. The closest point lies on one of
/// them; comparing distances instead of regions stays right for slivers, whose regions rounding can
/// tear open. \param from [m] from each corner to the centre
inline bool closest_on_sides(const Triangle& t,
                             const Vec3& centre,
                             const std::array<Vec3, 3>& from,
                             const std::array<double, 3>& inside,
                             double reach,
                             Closest& out) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double least = infinity;
    Vec3 offset{infinity, infinity, infinity};
    for (std::size_t k = 0; k < 3; ++k) {
        if (inside[k] > 0.0) {
            continue;
        }
        const std::size_t next = k == 2 ? 0 : k + 1;
        const double along = dot(t.side[k], from[k]) * t.inverse_square_side[k];
        const bool at_start = along <= 0.0;
        const bool at_end = along >= 1.0;
        const Vec3 to_side = at_start ? -from[k]
                             : at_end ? -from[next]
                                      : along * t.side[k] - from[k];
        const double squared = dot(to_side, to_side);
        if (squared < least) {
            least = squared;
            offset = to_side;
            const bool at_vertex = at_start || at_end;
            out.feature = at_vertex ? Feature::vertex : Feature::edge;
            out.id = at_vertex ? t.vertex[at_start ? k : next] : t.edge[k];
        }
    }
    return detail::set_rim(centre, offset, reach, t.normal, out);
}

/// Finds the closest point; false, with `out` unspecified, if it is farther than `reach`.
inline bool closest_within(const Triangle& t, const Vec3& centre, double reach, Closest& out) {
    const std::array<Vec3, 3> from{
        centre - t.corner[0], centre - t.corner[1], centre - t.corner[2]};
    // As core/kernels/search_pass.hpp has it, so that both give the same bits.
    const double height = dot(t.normal, centre) - t.offset;
    if (std::abs(height) > reach) {
        return false;
    }
    const std::array<double, 3> inside{
        dot(t.inward[0], from[0]), dot(t.inward[1], from[1]), dot(t.inward[2], from[2])};
    if (inside[0] > 0.0 && inside[1] > 0.0 && inside[2] > 0.0) {
        out.point = centre - height * t.normal;
        out.normal = detail::towards_face(t.normal, height);
        out.distance = std::abs(height);
        out.feature = Feature::face;
        out.id = no_feature;
        return true;
    }
    if (std::min({inside[0], inside[1], inside[2]}) < -reach) {
        return false;
    }
    return closest_on_sides(t, centre, from, inside, reach, out);
}

inline bool closest_within(const Plate& plate, const Vec3& centre, double reach, Closest& out) {
    const Vec3 from = centre - plate.centre;
    const double height = dot(plate.normal, centre) - plate.offset;
    if (std::abs(height) > reach) {
        return false;
    }
    const Vec3 radial = from - height * plate.normal;
    const double squared = dot(radial, radial);
    if (squared <= plate.radius * plate.radius && squared >= plate.hole * plate.hole) {
        out.point = centre - height * plate.normal;
        out.normal = detail::towards_face(plate.normal, height);
        out.distance = std::abs(height);
        out.feature = Feature::face;
        out.id = no_feature;
        return true;
    }
    const bool in_hole = squared < plate.hole * plate.hole;
    out.feature = Feature::edge;
    out.id = in_hole ? plate.hole_rim : plate.rim;
    const Vec3 outward = squared > 0.0 ? (1.0 / std::sqrt(squared)) * radial : plate.any_radial;
    const Vec3 rim = (in_hole ? plate.hole : plate.radius) * outward;
    return detail::set_rim(centre, rim - from, reach, plate.normal, out);
}

inline bool closest_within(const Shell& shell, const Vec3& centre, double reach, Closest& out) {
    const Vec3 from = centre - shell.base;
    const double along = dot(shell.axis, from);
    const Vec3 across = from - along * shell.axis;
    const double from_axis = norm(across);
    const double inward = shell.radius - from_axis;
    if (std::abs(inward) > reach) {
        return false;
    }
    const Vec3 radial = from_axis > 0.0 ? (1.0 / from_axis) * across : shell.any_radial;
    if (along >= 0.0 && along <= shell.height) {
        out.point = centre + inward * radial;
        out.normal = inward >= 0.0 ? radial : -radial;
        out.distance = std::abs(inward);
        out.feature = Feature::face;
        out.id = no_feature;
        return true;
    }
    const bool at_base = along < 0.0;
    out.feature = Feature::edge;
    out.id = shell.rim[at_base ? 0 : 1];
    const double up = at_base ? -along : shell.height - along;
    return detail::set_rim(centre, inward * radial + up * shell.axis, reach, radial, out);
}

}  // namespace grainbench
