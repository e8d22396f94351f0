/// Shapes of walls as a scene describes them. core/walls/surface.hpp makes contact geometry of
/// them.
#pragma once

#include "core/describe.hpp"
#include "core/types.hpp"

#include <string>
#include <variant>
#include <vector>

namespace grainbench {

/// Infinite plane; both sides repel, particles stay on the side where they start.
struct Plane {
    static constexpr std::string_view key = "plane";
    Vec3 point{};
    Vec3 normal{0.0, 0.0, 1.0};
    double view_size = 0.1;

    static constexpr auto fields() {
        return std::tuple{
            required(&Plane::point, "point", "m", any_number(), "a point of the plane"),
            required(&Plane::normal, "normal", "1", any_number(), "normal, of any length but 0"),
            field(&Plane::view_size,
                  "view_size",
                  "m",
                  positive(),
                  "edge of the square drawn in frames, about the point")};
    }
};

/// Flat round plate without thickness, with a round hole in its middle if asked.
struct Disc {
    static constexpr std::string_view key = "disc";
    Vec3 centre{};
    Vec3 normal{0.0, 0.0, 1.0};
    double radius = 1.0;
    double hole = 0.0;

    static constexpr auto fields() {
        return std::tuple{
            required(&Disc::centre, "centre", "m", any_number(), "centre"),
            required(&Disc::normal, "normal", "1", any_number(), "normal, of any length but 0"),
            required(&Disc::radius, "radius", "m", positive(), "radius"),
            field(&Disc::hole, "hole", "m", at_least(0.0), "radius of the hole; 0 = none")};
    }
};

/// Closed rectangular box, six faces, repels on both sides.
struct BoxShape {
    static constexpr std::string_view key = "box";
    Vec3 low{};
    Vec3 high{};

    static constexpr auto fields() {
        return std::tuple{
            required(&BoxShape::low, "low", "m", any_number(), "corner with small coordinates"),
            required(&BoxShape::high, "high", "m", any_number(), "corner with large coordinates")};
    }
};

/// Which faces of a cylinder exist.
enum class CylinderPart { all, side, caps, base, open_top };

template <>
struct EnumNames<CylinderPart> {
    static constexpr std::array<std::pair<CylinderPart, std::string_view>, 5> value{
        {{CylinderPart::all, "all"},
         {CylinderPart::side, "side"},
         {CylinderPart::caps, "caps"},
         {CylinderPart::base, "base"},
         {CylinderPart::open_top, "open_top"}}};
};

/// Exactly round cylinder.
struct Cylinder {
    static constexpr std::string_view key = "cylinder";
    Vec3 base{};
    Vec3 axis{0.0, 0.0, 1.0};
    double radius = 1.0;
    double height = 1.0;
    CylinderPart part = CylinderPart::all;

    static constexpr auto fields() {
        return std::tuple{
            required(&Cylinder::base, "base", "m", any_number(), "centre of the base"),
            field(&Cylinder::axis, "axis", "1", any_number(), "direction from base to top"),
            required(&Cylinder::radius, "radius", "m", positive(), "radius"),
            required(&Cylinder::height, "height", "m", positive(), "height along the axis"),
            field(&Cylinder::part,
                  "part",
                  "",
                  any_number(),
                  "faces that exist: all, side, caps, base (one cap) or open_top (side and base)")};
    }
};

/// Cylinder of triangles, inscribed: end circles get edges shorter than resolution * radius.
struct FacetedCylinder {
    static constexpr std::string_view key = "faceted_cylinder";
    Vec3 base{};
    Vec3 axis{0.0, 0.0, 1.0};
    double radius = 1.0;
    double height = 1.0;
    double resolution = 0.1;
    CylinderPart part = CylinderPart::all;

    static constexpr auto fields() {
        return std::tuple{
            required(&FacetedCylinder::base, "base", "m", any_number(), "centre of the base"),
            field(&FacetedCylinder::axis, "axis", "1", any_number(), "direction from base to top"),
            required(&FacetedCylinder::radius, "radius", "m", positive(), "radius of the vertices"),
            required(&FacetedCylinder::height, "height", "m", positive(), "height along the axis"),
            field(&FacetedCylinder::resolution,
                  "resolution",
                  "1",
                  positive(),
                  "longest edge of the end circles over the radius"),
            field(&FacetedCylinder::part,
                  "part",
                  "",
                  any_number(),
                  "faces that exist: all, side, caps, base (one cap) or open_top (side and base)")};
    }
};

/// Triangles from an STL or VTP file. io fills `vertices` and `triangles` before the scene is
/// built.
struct MeshFile {
    static constexpr std::string_view key = "mesh";
    std::string path;
    double scale = 1.0;

    static constexpr auto fields() {
        return std::tuple{
            required(&MeshFile::path,
                     "path",
                     "",
                     any_number(),
                     "STL or VTP file, relative to the scene"),
            field(&MeshFile::scale, "scale", "m", positive(), "length of one unit of the file")};
    }

    std::vector<Vec3> vertices;                   ///< as read, scaled; not part of the JSON
    std::vector<std::array<Index, 3>> triangles;  ///< indices into vertices
};

/// Triangles written in the scene itself.
struct Triangles {
    static constexpr std::string_view key = "triangles";
    std::vector<Vec3> vertices;
    std::vector<std::vector<std::int64_t>> triangles;

    static constexpr auto fields() {
        return std::tuple{required(&Triangles::vertices, "vertices", "m", any_number(), "points"),
                          required(&Triangles::triangles,
                                   "triangles",
                                   "",
                                   at_least(0),
                                   "three indices into vertices for each triangle")};
    }
};

using WallShape =
    std::variant<Plane, Disc, BoxShape, Cylinder, FacetedCylinder, MeshFile, Triangles>;

}  // namespace grainbench
