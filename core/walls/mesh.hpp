/// Triangles of a wall with their connectivity and a tree for finding them.
#pragma once

#include "core/frame.hpp"
#include "core/walls/bounds.hpp"
#include "core/walls/closest.hpp"
#include "core/walls/faceted.hpp"

#include <span>
#include <string>
#include <vector>

namespace grainbench {

class TriangleMesh {
public:
    TriangleMesh() = default;

    /// Points at exactly the same place become one vertex. Throws Error(bad_input) on triangles
    /// without area; `where` names the wall.
    TriangleMesh(const IndexedTriangles& given, const std::string& where);

    std::span<const Triangle> triangles() const { return triangles_; }

    const BoundsTree& tree() const { return tree_; }

    /// True if every edge joins an even number of triangles, so that inside and outside exist.
    bool is_closed() const { return is_closed_; }

    /// True if the point lies inside; the mesh must be closed.
    bool contains(const Vec3& point) const;

    /// Smallest distance from the point, or infinity if it exceeds `most` [m].
    double distance(const Vec3& point, double most) const;

    double extent_from(const Vec3& point) const;

    WallSurface outline() const;

private:
    void number_edges();

    std::vector<Vec3> vertices_;
    std::vector<Triangle> triangles_;
    BoundsTree tree_;
    bool is_closed_ = false;
};

}  // namespace grainbench
