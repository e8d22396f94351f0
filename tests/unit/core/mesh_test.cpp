#include "core/error.hpp"
#include "core/walls/surface.hpp"

#include "tests/unit/core/wall_support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace grainbench {
namespace {

Surface surface_of(const WallShape& shape) {
    return {shape, "/walls/3"};
}

/// Volume inside polygons that all face outward, by the divergence theorem.
double enclosed_volume(const WallSurface& outline) {
    double sum = 0.0;
    for (const std::vector<Index>& polygon : outline.polygons) {
        for (std::size_t k = 2; k < polygon.size(); ++k) {
            sum += dot(outline.points[polygon[0]],
                       cross(outline.points[polygon[k - 1]], outline.points[polygon[k]]));
        }
    }
    return sum / 6.0;
}

TEST(FacetedCylinder, HasThirteenEdgesAtTheResolutionOfTheExample) {
    const Surface container = surface_of(example_container());
    EXPECT_EQ(container.patch_count(), 52U);  // 26 of the side, 13 of each cap
    // Published to 5 digits: half of the last one.
    EXPECT_NEAR(container.distance({}), 48.547e-3, 0.5e-6);
    const double area = enclosed_volume(container.outline()) / 0.2;
    EXPECT_NEAR(area, 7.5518e-3, 0.5e-7);
}

TEST(FacetedCylinder, MakesEdgesShorterThanTheResolutionButNoMoreThanNeeded) {
    for (const double resolution : {3.0, 2.0, 1.7, 1.0, 0.5, 0.3, 0.1, 0.03}) {
        FacetedCylinder shape = example_container(CylinderPart::base);
        shape.resolution = resolution;
        const auto n = static_cast<double>(surface_of(shape).patch_count());
        EXPECT_LT(2.0 * std::sin(pi / n), resolution);
        EXPECT_TRUE(n == 3.0 || 2.0 * std::sin(pi / (n - 1.0)) >= resolution);
    }
    FacetedCylinder endless = example_container();
    endless.resolution = 1e-9;
    EXPECT_THROW(surface_of(endless), Error);
}

TEST(FacetedCylinder, HasOnlyThePartsAskedFor) {
    const auto count = [](CylinderPart part) {
        return surface_of(example_container(part)).patch_count();
    };
    EXPECT_EQ(count(CylinderPart::side), 26U);
    EXPECT_EQ(count(CylinderPart::caps), 26U);
    EXPECT_EQ(count(CylinderPart::base), 13U);
    EXPECT_EQ(count(CylinderPart::open_top), 39U);
    EXPECT_EQ(surface_of(example_container(CylinderPart::side)).outline().points.size(), 26U);
    const Surface base = surface_of(example_container(CylinderPart::base));
    EXPECT_NEAR(base.distance({0, 0, -0.07}), 0.03, round_off(4, 0.1));
    EXPECT_TRUE(base.encloses({0, 0, -0.07}, 0.02));
    EXPECT_FALSE(base.encloses({0.04, 0, -0.07}, 0.02));  // open parts count as closed
}

TEST(Outline, FacesOutward) {
    EXPECT_NEAR(enclosed_volume(surface_of(BoxShape{{-1, 2, 3}, {1, 5, 4}}).outline()), 6.0, 1e-14);
    const Cylinder round{.base = {1, 1, 1}, .axis = {0, 1, 0}, .radius = 2.0, .height = 3.0};
    const double area_of_64 = 32.0 * 4.0 * std::sin(2.0 * pi / 64.0);
    EXPECT_NEAR(enclosed_volume(surface_of(round).outline()), 3.0 * area_of_64, 1e-12);
    FacetedCylinder tilted = example_container();
    tilted.axis = {-1, 2, -0.5};
    EXPECT_NEAR(enclosed_volume(surface_of(tilted).outline()), 0.2 * 7.5518e-3, 1e-8);
}

TEST(Box, EnclosesWhatFitsInside) {
    const Surface box = surface_of(BoxShape{{0, 0, 0}, {1, 2, 3}});
    EXPECT_EQ(box.patch_count(), 12U);
    EXPECT_TRUE(box.encloses({0.5, 1.0, 1.5}, 0.5));  // on diagonals, touching two faces
    EXPECT_TRUE(box.encloses({0.25, 0.25, 0.25}, 0.25));
    EXPECT_FALSE(box.encloses({0.25, 0.25, 0.25}, 0.2500001));
    EXPECT_FALSE(box.encloses({1.5, 1.0, 1.5}, 0.1));
    EXPECT_FALSE(box.encloses({-0.5, 1.0, 1.5}, 0.1));
    EXPECT_NEAR(box.extent_from({0, 0, 0}), std::sqrt(14.0), round_off(2, 4.0));
}

TEST(Enclosure, IsRightForPointsInLineWithVerticesAndEdges) {
    // Grid points lie in line with vertices, edges and faces along every axis.
    const Surface box = surface_of(BoxShape{{-2, -2, -2}, {2, 2, 2}});
    for (int i = -3; i <= 3; ++i) {
        for (int j = -3; j <= 3; ++j) {
            for (int k = -3; k <= 3; ++k) {
                const bool is_inside = std::max({std::abs(i), std::abs(j), std::abs(k)}) < 2;
                EXPECT_EQ(box.encloses({1.0 * i, 1.0 * j, 1.0 * k}, 0.5), is_inside);
            }
        }
    }
}

TEST(Enclosure, IsRefusedForSurfacesThatHoldNothing) {
    EXPECT_THROW(surface_of(Plane{}).encloses({}, 0.1), Error);
    EXPECT_THROW(surface_of(Disc{}).encloses({}, 0.1), Error);
    const Surface open = surface_of(terrain(2, 1.0, [](double, double) { return 0.0; }));
    try {
        open.encloses({}, 0.1);
        FAIL() << "an open mesh enclosed something";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::bad_input);
        EXPECT_EQ(error.diagnosis().where, "/walls/3");
    }
}

TEST(Mesh, FindsExactlyThePatchesWithinReach) {
    RandomPoints random(7);
    const Triangles ground =
        terrain(30, 1.0, [&](double, double) { return random.between(-0.05, 0.05); });
    const Surface surface = surface_of(ground);
    ASSERT_EQ(surface.patch_count(), 1800U);
    std::vector<Surface> single;
    for (const auto& t : ground.triangles) {
        const auto at = [&](std::size_t k) {
            return ground.vertices[static_cast<std::size_t>(t[k])];
        };
        single.push_back(surface_of(Triangles{{at(0), at(1), at(2)}, {{0, 1, 2}}}));
    }
    for (int trial = 0; trial < 200; ++trial) {
        const Vec3 p = random.in_cube(0.6);
        const double reach = random.between(0.01, 0.3);
        std::vector<Index> expected{7777};  // collect appends
        double least = 1e300;
        for (Index k = 0; k < single.size(); ++k) {
            const double distance = single[k].distance(p);
            least = std::min(least, distance);
            if (distance <= reach) {
                expected.push_back(k);
            }
        }
        std::vector<Index> found{7777};
        surface.collect(p, reach, found);
        EXPECT_EQ(found, expected);
        EXPECT_EQ(surface.distance(p), least);
    }
}

/// What the planes say of every patch against the closest point itself.
TEST(Mesh, BoundsDistancesByItsPlanes) {
    RandomPoints random(8);
    int faces = 0;
    int far = 0;
    for (const WallShape& shape : {WallShape{example_container()},
                                   WallShape{Cylinder{}},
                                   WallShape{Disc{}},
                                   WallShape{Plane{.normal = {1, 2, 3}}}}) {
        const Surface surface = surface_of(shape);
        const std::span<const double> planes = surface.planes();
        ASSERT_EQ(planes.size(), 16 * surface.patch_count());
        for (int trial = 0; trial < 300; ++trial) {
            const Vec3 p = random.in_cube(0.1);
            for (Index k = 0; k < surface.patch_count(); ++k) {
                const auto over = [&](std::size_t n) {
                    const double* plane = planes.data() + 16 * std::size_t{k} + 4 * n;
                    return dot(Vec3{plane[0], plane[1], plane[2]}, p) - plane[3];
                };
                const auto is_near = [&](double reach) {
                    const std::vector<Index> near = patches_near(surface, p, reach);
                    return std::binary_search(near.begin(), near.end(), k);
                };
                const double rounding = round_off(8, 4.0);
                const double height = std::abs(over(0));
                EXPECT_FALSE(is_near(height - rounding));
                const double inside = std::min({over(1), over(2), over(3)});
                if (inside > rounding) {
                    WallHits hits;
                    surface.resolve(p, height + rounding, std::array{k}, hits);
                    ASSERT_EQ(hits.count, 1U);
                    EXPECT_EQ(hits.hit[0].feature, Feature::face);
                    EXPECT_EQ(hits.hit[0].distance, height);
                    ++faces;
                } else if (inside < -rounding) {
                    EXPECT_FALSE(is_near(-inside - rounding));
                    ++far;
                }
            }
        }
    }
    EXPECT_GT(faces, 500);
    EXPECT_GT(far, 1000);
}

TEST(Mesh, SharesVerticesAtTheSamePlaceOnly) {
    // A strip written as separate triangles, as STL files do.
    const Triangles strip{{{0, 0, 0},
                           {1, 0, 0},
                           {0, 1, 0},
                           {1, 0, 0},
                           {1, 1, 0},
                           {0, 1, 0},
                           {1, 1, 0},
                           {2, 1, 0},
                           {1, 2, 0},
                           {5, 5, 0},
                           {6, 5, 0},
                           {5, 6, 0}},
                          {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}}};
    const Surface surface = surface_of(strip);
    EXPECT_TRUE(surface.adjacent(0, 0));
    EXPECT_TRUE(surface.adjacent(0, 1));
    EXPECT_TRUE(surface.adjacent(2, 1));
    EXPECT_FALSE(surface.adjacent(0, 2));
    EXPECT_FALSE(surface.adjacent(3, 1));
    const std::vector<WallHit> hits = hits_of(surface, {0.5, 0.5, 0.1}, 0.2);
    ASSERT_EQ(hits.size(), 1U);  // on the seam of the first two
    EXPECT_EQ(hits[0].patch, 0U);
}

TEST(Mesh, RefusesWhatHasNoGeometry) {
    const auto refused = [](const WallShape& shape, const std::string& where) {
        try {
            surface_of(shape);
        } catch (const Error& error) {
            return error.diagnosis().where.find(where) == 0;
        }
        return false;
    };
    const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}};
    EXPECT_TRUE(refused(Triangles{points, {{0, 1, 3}, {0, 1, 2}}}, "/walls/3/shape, triangle 1"));
    EXPECT_TRUE(refused(Triangles{points, {{0, 1, 4}}}, "/walls/3/shape/triangles/0"));
    EXPECT_TRUE(refused(Triangles{points, {{0, 1}}}, "/walls/3/shape/triangles/0"));
    EXPECT_TRUE(refused(MeshFile{}, "/walls/3/shape"));
    EXPECT_TRUE(refused(BoxShape{{0, 0, 0}, {1, 0, 1}}, "/walls/3/shape/high"));
    EXPECT_TRUE(refused(Plane{.normal = {}}, "/walls/3/shape/normal"));
    EXPECT_TRUE(refused(Cylinder{.height = 0.0}, "/walls/3/shape/height"));
}

TEST(Surface, HasNoPatchesByDefault) {
    const Surface empty;
    EXPECT_EQ(empty.patch_count(), 0U);
    EXPECT_TRUE(hits_of(empty, {}, 1.0).empty());
    EXPECT_EQ(empty.distance({}), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace grainbench
