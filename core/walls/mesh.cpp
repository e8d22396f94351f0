#include "core/walls/mesh.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>
#include <utility>

namespace grainbench {

namespace {

/// Height over longest side below which a triangle has no usable normal: doubles of coordinates
/// leave it no correct digits.
constexpr double flattest = 1e-12;

std::tuple<double, double, double> key_of(const Vec3& p) {
    return {p.x, p.y, p.z};
}

/// Number of the vertex at each point in use; points at the same place get the same number.
std::vector<Index> merge_points(const IndexedTriangles& given, std::vector<Vec3>& vertices) {
    const std::vector<Vec3>& points = given.points;
    std::vector<Index> order;
    for (const auto& corners : given.triangles) {
        order.insert(order.end(), corners.begin(), corners.end());
    }
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
        return key_of(points[a]) < key_of(points[b]);
    });
    std::vector<Index> number(points.size());
    for (const Index k : order) {
        if (vertices.empty() || !(vertices.back() == points[k])) {
            vertices.push_back(points[k]);
        }
        number[k] = static_cast<Index>(vertices.size() - 1);
    }
    return number;
}

bool set_geometry(Triangle& t) {
    for (std::size_t k = 0; k < 3; ++k) {
        t.side[k] = t.corner[(k + 1) % 3] - t.corner[k];
        t.inverse_square_side[k] = 1.0 / dot(t.side[k], t.side[k]);
    }
    const Vec3 area = cross(t.side[0], -t.side[2]);
    const double longest = std::max({norm(t.side[0]), norm(t.side[1]), norm(t.side[2])});
    if (!(norm(area) > flattest * longest * longest)) {
        return false;
    }
    t.normal = normalized(area);
    t.offset = dot(t.normal, t.corner[0]);
    for (std::size_t k = 0; k < 3; ++k) {
        t.inward[k] = normalized(cross(t.normal, t.side[k]));
    }
    return true;
}

Bounds bounds_of(const Triangle& t) {
    Bounds bounds;
    for (const Vec3& corner : t.corner) {
        bounds.include(corner);
    }
    return bounds;
}

/// True if the line through `from` along x passes the triangle beyond `from`. Triangles that share
/// a side judge it from the same end, so that a line through the side passes exactly one of them.
bool is_crossed_along_x(const Triangle& t, const Vec3& from) {
    bool is_covered = false;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        const bool in_order = t.vertex[k] < t.vertex[next];
        const Vec3& a = t.corner[in_order ? k : next];
        const Vec3& b = t.corner[in_order ? next : k];
        if ((a.z > from.z) != (b.z > from.z)) {
            const double turn = (b.y - a.y) * (from.z - a.z) - (b.z - a.z) * (from.y - a.y);
            is_covered ^= (b.z > a.z) == (turn > 0.0);
        }
    }
    return is_covered && dot(t.normal, from - t.corner[0]) * t.normal.x < 0.0;
}

}  // namespace

TriangleMesh::TriangleMesh(const IndexedTriangles& given, const std::string& where) {
    if (given.triangles.empty() ||
        !std::all_of(given.points.begin(), given.points.end(), is_finite)) {
        throw_bad_input(
            {.what = "a wall of triangles has no triangle or a vertex that is not finite",
             .where = where + "/shape",
             .likely_cause = "the mesh is empty or damaged",
             .next_step = "look at the mesh in a viewer and export it anew"});
    }
    const std::vector<Index> number = merge_points(given, vertices_);
    triangles_.resize(given.triangles.size());
    std::vector<Bounds> bounds;
    for (std::size_t k = 0; k < triangles_.size(); ++k) {
        Triangle& t = triangles_[k];
        for (std::size_t c = 0; c < 3; ++c) {
            t.vertex[c] = number[given.triangles[k][c]];
            t.corner[c] = vertices_[t.vertex[c]];
        }
        if (!set_geometry(t)) {
            throw_bad_input(
                {.what = "a triangle has no area",
                 .where = where + "/shape, triangle " + std::to_string(k) + " (from 0)",
                 .likely_cause = "two of its vertices coincide or all three lie on a line",
                 .next_step = "remove degenerate triangles from the mesh"});
        }
        bounds.push_back(bounds_of(t));
    }
    number_edges();
    tree_ = BoundsTree(std::move(bounds));
}

void TriangleMesh::number_edges() {
    struct Side {
        std::pair<Index, Index> ends;
        Index* edge;
    };

    std::vector<Side> sides;
    for (Triangle& t : triangles_) {
        for (std::size_t k = 0; k < 3; ++k) {
            sides.push_back({std::minmax({t.vertex[k], t.vertex[(k + 1) % 3]}), &t.edge[k]});
        }
    }
    std::stable_sort(
        sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.ends < b.ends; });
    is_closed_ = true;
    Index edge = 0;
    for (std::size_t first = 0; first < sides.size(); ++edge) {
        std::size_t last = first;
        for (; last < sides.size() && sides[last].ends == sides[first].ends; ++last) {
            *sides[last].edge = edge;
        }
        is_closed_ = is_closed_ && (last - first) % 2 == 0;
        first = last;
    }
}

bool TriangleMesh::contains(const Vec3& point) const {
    bool is_inside = false;
    tree_.visit(
        [&](const Bounds& b) {
            return b.low.y <= point.y && point.y <= b.high.y && b.low.z <= point.z &&
                   point.z <= b.high.z && point.x <= b.high.x;
        },
        [&](Index k) { is_inside ^= is_crossed_along_x(triangles_[k], point); });
    return is_inside;
}

double TriangleMesh::distance(const Vec3& point, double most) const {
    double least = most;
    bool is_found = false;
    Closest closest;
    tree_.visit([&](const Bounds& b) { return b.squared_distance(point) <= least * least; },
                [&](Index k) {
                    if (closest_within(triangles_[k], point, least, closest)) {
                        least = closest.distance;
                        is_found = true;
                    }
                });
    return is_found ? least : std::numeric_limits<double>::infinity();
}

double TriangleMesh::extent_from(const Vec3& point) const {
    double most = 0.0;
    for (const Vec3& vertex : vertices_) {
        most = std::max(most, norm(vertex - point));
    }
    return most;
}

WallSurface TriangleMesh::outline() const {
    WallSurface outline;
    outline.points = vertices_;
    for (const Triangle& t : triangles_) {
        outline.polygons.emplace_back(t.vertex.begin(), t.vertex.end());
    }
    return outline;
}

}  // namespace grainbench
