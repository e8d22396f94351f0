/// Walls with exact shapes: planes, discs and cylinders, as a few patches of two kinds.
#pragma once

#include "core/frame.hpp"
#include "core/walls/closest.hpp"
#include "core/walls/shapes.hpp"

#include <string>
#include <variant>
#include <vector>

namespace grainbench {

using RoundPatch = std::variant<Plate, Shell>;

inline bool has_feature(const RoundPatch& patch, Feature feature, Index id) {
    return std::visit([&](const auto& kind) { return has_feature(kind, feature, id); }, patch);
}

inline bool closest_within(const RoundPatch& patch,
                           const Vec3& centre,
                           double reach,
                           Closest& out) {
    return std::visit([&](const auto& kind) { return closest_within(kind, centre, reach, out); },
                      patch);
}

/// Directions have unit length from here on.
std::vector<RoundPatch> round_patches(const Plane& plane);
std::vector<RoundPatch> round_patches(const Disc& disc);
std::vector<RoundPatch> round_patches(const Cylinder& cylinder);

WallSurface round_outline(const Plane& plane);
WallSurface round_outline(const Disc& disc);
WallSurface round_outline(const Cylinder& cylinder);

/// Largest distance of a patch from a point [m].
double extent_of(const RoundPatch& patch, const Vec3& point);

/// True if the sphere lies within the cylinder with all its faces.
bool cylinder_encloses(const Cylinder& cylinder, const Vec3& centre, double radius);

}  // namespace grainbench
