#include "core/walls/surface.hpp"

#include "core/describe.hpp"
#include "core/error.hpp"
#include "core/state/aligned.hpp"
#include "core/walls/closest.hpp"
#include "core/walls/faceted.hpp"
#include "core/walls/mesh.hpp"
#include "core/walls/round.hpp"
#include "core/walls/rule.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <variant>

namespace grainbench {

namespace {

/// More edges than this are a slip of the pen, and their triangles would fill the memory.
constexpr double finest_resolution = 1e-4;

[[noreturn]] void throw_bad_shape(const std::string& where,
                                  const std::string& what,
                                  const std::string& cause,
                                  const std::string& next_step) {
    throw_bad_input({.what = what, .where = where, .likely_cause = cause, .next_step = next_step});
}

Vec3 unit_direction(const Vec3& given, const std::string& where) {
    const double length = norm(given);
    if (!std::isfinite(length) || !(length > 0.0)) {
        throw_bad_shape(where,
                        "a direction has no length",
                        "all three components are zero, or one is not finite",
                        "give a vector of any length but 0, such as [0, 0, 1]");
    }
    return (1.0 / length) * given;
}

void check_length(double length, const std::string& where) {
    if (!std::isfinite(length) || !(length > 0.0)) {
        throw_bad_shape(where,
                        "a length of a wall is not positive",
                        "the value is zero, negative or not finite",
                        "give a length greater than 0 in metres");
    }
}

void check_point(const Vec3& point, const std::string& where) {
    if (!is_finite(point)) {
        throw_bad_shape(where,
                        "a point of a wall is not finite",
                        "a coordinate is infinite or not a number",
                        "give three finite coordinates in metres");
    }
}

Plane checked(Plane plane, const std::string& where) {
    check_point(plane.point, where + "/shape/point");
    plane.normal = unit_direction(plane.normal, where + "/shape/normal");
    return plane;
}

Disc checked(Disc disc, const std::string& where) {
    check_point(disc.centre, where + "/shape/centre");
    check_length(disc.radius, where + "/shape/radius");
    check_length(disc.radius - disc.hole, where + "/shape/hole");
    disc.normal = unit_direction(disc.normal, where + "/shape/normal");
    return disc;
}

BoxShape checked(BoxShape box, const std::string& where) {
    check_point(box.low, where + "/shape/low");
    check_point(box.high, where + "/shape/high");
    const Vec3 size = box.high - box.low;
    check_length(std::min({size.x, size.y, size.z}), where + "/shape/high");
    return box;
}

template <class AnyCylinder>
AnyCylinder checked_cylinder(AnyCylinder cylinder, const std::string& where) {
    check_point(cylinder.base, where + "/shape/base");
    check_length(cylinder.radius, where + "/shape/radius");
    check_length(cylinder.height, where + "/shape/height");
    cylinder.axis = unit_direction(cylinder.axis, where + "/shape/axis");
    return cylinder;
}

FacetedCylinder checked(const FacetedCylinder& cylinder, const std::string& where) {
    if (!(cylinder.resolution >= finest_resolution)) {
        throw_bad_shape(where + "/shape/resolution",
                        "the facets of a cylinder are too fine to be built",
                        "resolution is the longest edge over the radius, here below 1e-4",
                        "use a coarser resolution, or the exactly round shape \"cylinder\"");
    }
    return checked_cylinder(cylinder, where);
}

}  // namespace

struct Surface::Impl {
    std::string where;
    TriangleMesh mesh;              // either this has triangles
    std::vector<RoundPatch> round;  // or this has patches
    TriangleMesh complete_mesh;     // with the faces that an open cylinder lacks, if it does
    std::optional<Cylinder> cylinder;
    Column<double> planes;
    Column<double> shells;
    WallSurface outline;

    Impl() = default;

    Impl(const WallShape& shape, std::string name) : where(std::move(name)) {
        std::visit([&](const auto& s) { build(s); }, shape);
        for (const Triangle& t : mesh.triangles()) {
            add_plane(t.normal, t.offset);
            for (std::size_t k = 0; k < 3; ++k) {
                add_plane(t.inward[k], dot(t.inward[k], t.corner[k]));
            }
        }
        for (const RoundPatch& patch : round) {
            const auto* plate = std::get_if<Plate>(&patch);
            plate ? add_plane(plate->normal, plate->offset) : add_plane({}, 0.0);
            const bool endless = plate != nullptr && std::isinf(plate->radius);
            for (int k = 0; k < 3; ++k) {
                add_plane({}, endless ? -1.0 : 0.0);
            }
        }
        add_shells();
    }

    void build(const Plane& plane) { build_round(checked(plane, where)); }

    void build(const Disc& disc) { build_round(checked(disc, where)); }

    void build(const Cylinder& given) {
        cylinder = checked_cylinder(given, where);
        build_round(*cylinder);
    }

    void build(const BoxShape& box) { build_mesh(box_triangles(checked(box, where))); }

    void build(const FacetedCylinder& given) {
        FacetedCylinder usable = checked(given, where);
        build_mesh(cylinder_triangles(usable));
        if (usable.part != CylinderPart::all) {
            usable.part = CylinderPart::all;
            complete_mesh = TriangleMesh(cylinder_triangles(usable), where);
        }
    }

    void build(const MeshFile& file) { build_mesh({file.vertices, file.triangles}); }

    void build(const Triangles& list) { build_mesh(listed_triangles(list, where)); }

    void build_mesh(const IndexedTriangles& triangles) {
        mesh = TriangleMesh(triangles, where);
        outline = mesh.outline();
    }

    template <class Shape>
    void build_round(const Shape& shape) {
        round = round_patches(shape);
        outline = round_outline(shape);
    }

    void add_plane(const Vec3& normal, double offset) {
        planes.insert(planes.end(), {normal.x, normal.y, normal.z, offset});
    }

    void add_shells() {
        const auto is_shell = [](const RoundPatch& patch) {
            return std::holds_alternative<Shell>(patch);
        };
        if (std::none_of(round.begin(), round.end(), is_shell)) {
            return;
        }
        for (const RoundPatch& patch : round) {
            const auto* given = std::get_if<Shell>(&patch);
            const Shell shell = given != nullptr ? *given : Shell{};
            const double radius = given != nullptr ? shell.radius : 0.0;
            shells.insert(shells.end(),
                          {shell.axis.x,
                           shell.axis.y,
                           shell.axis.z,
                           radius,
                           shell.base.x,
                           shell.base.y,
                           shell.base.z,
                           0.0});
        }
    }

    const TriangleMesh& enclosure() const {
        return complete_mesh.triangles().empty() ? mesh : complete_mesh;
    }
};

Surface::Surface() : impl_(std::make_shared<Impl>()) {}

Surface::Surface(const WallShape& shape, const std::string& where)
    : impl_(std::make_shared<Impl>(shape, where)) {}

std::size_t Surface::patch_count() const {
    return impl_->mesh.triangles().size() + impl_->round.size();
}

std::span<const double> Surface::planes() const {
    return impl_->planes;
}

std::span<const double> Surface::shells() const {
    return impl_->shells;
}

double Surface::collect(const Vec3& centre, double reach, std::vector<Index>& patches) const {
    const auto first = static_cast<std::ptrdiff_t>(patches.size());
    const std::span<const Triangle> triangles = impl_->mesh.triangles();
    const std::vector<RoundPatch>& round = impl_->round;
    Closest closest;
    double nearest = round.empty() ? std::numeric_limits<double>::infinity() : reach * reach;
    impl_->mesh.tree().visit(
        [&](const Bounds& b) {
            const double square = b.squared_distance(centre);
            const bool is_near = square <= reach * reach;
            nearest = is_near ? nearest : std::min(nearest, square);
            return is_near;
        },
        [&](Index k) {
            if (closest_within(triangles[k], centre, reach, closest)) {
                patches.push_back(k);
            } else {
                nearest = reach * reach;
            }
        });
    std::sort(patches.begin() + first, patches.end());
    for (Index k = 0; k < round.size(); ++k) {
        if (closest_within(round[k], centre, reach, closest)) {
            patches.push_back(k);
        }
    }
    return std::sqrt(nearest);
}

void Surface::resolve(const Vec3& centre,
                      double reach,
                      std::span<const Index> patches,
                      WallHits& hits) const {
    if (impl_->round.empty()) {
        resolve_hits<Triangle>(impl_->mesh.triangles(), centre, reach, patches, hits);
    } else {
        resolve_hits<RoundPatch>(impl_->round, centre, reach, patches, hits);
    }
}

bool Surface::adjacent(Index a, Index b) const {
    if (a == b) {
        return true;
    }
    if (impl_->round.empty()) {
        const std::span<const Triangle> triangles = impl_->mesh.triangles();
        return std::any_of(triangles[a].vertex.begin(), triangles[a].vertex.end(), [&](Index v) {
            return has_feature(triangles[b], Feature::vertex, v);
        });
    }
    // The side of a cylinder meets both caps; the caps do not meet.
    return std::holds_alternative<Shell>(impl_->round[a]) ||
           std::holds_alternative<Shell>(impl_->round[b]);
}

bool Surface::encloses(const Vec3& centre, double radius) const {
    if (impl_->cylinder) {
        return cylinder_encloses(*impl_->cylinder, centre, radius);
    }
    const TriangleMesh& mesh = impl_->enclosure();
    if (mesh.triangles().empty() || !mesh.is_closed()) {
        throw_bad_shape(impl_->where,
                        "a wall is asked what it holds but encloses no space",
                        "it is a plane, a disc or a mesh with open edges",
                        "name a box, a cylinder or a closed mesh, or leave out \"inside\"");
    }
    const Bounds& all = mesh.tree().all();
    const Vec3 margin{radius, radius, radius};
    const Vec3 above = centre - margin - all.low;
    const Vec3 below = all.high - centre - margin;
    return std::min({above.x, above.y, above.z, below.x, below.y, below.z}) >= 0.0 &&
           mesh.distance(centre, radius) >= radius && mesh.contains(centre);
}

double Surface::distance(const Vec3& centre) const {
    double least = impl_->mesh.distance(centre, std::numeric_limits<double>::infinity());
    Closest closest;
    for (const RoundPatch& patch : impl_->round) {
        if (closest_within(patch, centre, least, closest)) {
            least = closest.distance;
        }
    }
    return least;
}

double Surface::extent_from(const Vec3& point) const {
    double most = impl_->mesh.extent_from(point);
    for (const RoundPatch& patch : impl_->round) {
        most = std::max(most, extent_of(patch, point));
    }
    return most;
}

const WallSurface& Surface::outline() const {
    return impl_->outline;
}

}  // namespace grainbench
