/// Contact geometry of one wall in its own frame: patches (triangles, planes, discs, cylinder
/// sides), the closest points on them, and the rule that lets one physical contact act once.
#pragma once

#include "core/frame.hpp"
#include "core/types.hpp"
#include "core/walls/shapes.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace grainbench {

/// Where on a patch the closest point lies; face takes precedence over edge over vertex.
enum class Feature : std::uint8_t { face, edge, vertex };

/// One accepted contact of a sphere with a wall.
struct WallHit {
    Index patch = 0;  ///< the patch that stands for it (the lowest of those that share the point)
    Feature feature = Feature::face;
    Vec3 point{};           ///< [m] closest point, in the wall's frame
    Vec3 normal{};          ///< [1] from the centre of the sphere to `point`
    double distance = 0.0;  ///< [m] from the centre to `point`
};

/// A few hits without allocation. A sphere touching more patches than fit keeps the closest ones.
struct WallHits {
    static constexpr std::size_t capacity = 16;
    std::array<WallHit, capacity> hit;
    std::size_t count = 0;

    std::span<const WallHit> view() const { return {hit.data(), count}; }
};

class Surface {
public:
    /// A surface without patches.
    Surface();

    /// Throws Error(bad_input) on degenerate shapes; `where` is the JSON pointer of the wall.
    Surface(const WallShape& shape, const std::string& where);

    std::size_t patch_count() const;

    /// Four packets per patch {n_x, n_y, n_z, d}. The first is a plane: |n . c - d| never exceeds
    /// the distance from c to the patch. Where n . c > d for the three others too, by more than
    /// rounding, the closest point of a triangle or plane lies in the face; where n . c < d by more
    /// than a distance for any of them, the patch is farther than that. All zero where no such
    /// planes exist (cylinder sides): that says nothing.
    std::span<const double> planes() const;

    /// Two packets per patch, {axis, radius} and {point of the axis, 0}, of those that are sides of
    /// cylinders: such a patch is never nearer than the distance from its full cylinder. The radius
    /// of other patches is zero. Empty where no patch is such a side.
    std::span<const double> shells() const;

    /// Appends, ascending, the patches whose distance from `centre` is at most `reach`. Returns a
    /// distance, at least `reach`, that none of the others is nearer than.
    double collect(const Vec3& centre, double reach, std::vector<Index>& patches) const;

    /// Contacts of a sphere at `centre` with those of `patches` (ascending) that are within
    /// `reach`, after the rule: every face hit acts; an edge hit acts once and only if no face at
    /// that edge acts; a vertex hit once and only if nothing at that vertex acts; coinciding points
    /// merge.
    void resolve(const Vec3& centre,
                 double reach,
                 std::span<const Index> patches,
                 WallHits& hits) const;

    /// True if a contact may pass its history from one patch to the other: same, or sharing a
    /// vertex.
    bool adjacent(Index a, Index b) const;

    /// True if the sphere lies entirely within the closed surface. Open parts of a cylinder count
    /// as closed. Throws Error(bad_input) for shapes that enclose nothing (plane, disc, open mesh).
    bool encloses(const Vec3& centre, double radius) const;

    /// Smallest distance from the centre to the surface.
    double distance(const Vec3& centre) const;

    /// Largest distance of the surface from a point [m]; infinite for a plane.
    double extent_from(const Vec3& point) const;

    /// Polygons for frames, in the wall's own frame.
    const WallSurface& outline() const;

private:
    struct Impl;
    std::shared_ptr<const Impl> impl_;  // never changes: copies share it
};

}  // namespace grainbench
