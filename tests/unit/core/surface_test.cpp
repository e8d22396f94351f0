#include "core/walls/surface.hpp"

#include "core/error.hpp"
#include "core/walls/closest.hpp"

#include "tests/unit/core/wall_support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace grainbench {
namespace {

constexpr double ball = 0.01;  // [m] radius, for paths along walls

Surface surface_of(const WallShape& shape) {
    return {shape, "/walls/0"};
}

Surface single_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
    return surface_of(Triangles{{a, b, c}, {{0, 1, 2}}});
}

double length_between(const Vec3& a, const Vec3& b) {
    return norm(a - b);
}

/// Least distance to samples of a triangle: (n + 1)(n + 2) / 2 points, edges and vertices included.
double sampled_distance(const Vec3& p, const std::array<Vec3, 3>& corner, int n) {
    double least = 1e300;
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= n - i; ++j) {
            const double u = static_cast<double>(i) / n;
            const double v = static_cast<double>(j) / n;
            least = std::min(
                least,
                length_between(p, (1.0 - u - v) * corner[0] + u * corner[1] + v * corner[2]));
        }
    }
    return least;
}

TEST(ClosestPoint, OfATriangleIsNeitherMissedNorBeatenBySamples) {
    RandomPoints random(1);
    constexpr int n = 120;
    std::array<int, 3> seen{};
    for (int trial = 0; trial < 60; ++trial) {
        const std::array<Vec3, 3> corner{
            random.in_cube(1.0), random.in_cube(1.0), random.in_cube(1.0)};
        const Surface surface = single_triangle(corner[0], corner[1], corner[2]);
        const Vec3 p = random.in_cube(2.0);
        const std::vector<WallHit> hits = hits_of(surface, p, 10.0);
        ASSERT_EQ(hits.size(), 1U);
        const WallHit& hit = hits[0];
        ++seen[static_cast<std::size_t>(hit.feature)];
        // A sample lies within one spacing (longest side 3.5 over n) of any point of the triangle.
        const double sampled = sampled_distance(p, corner, n);
        EXPECT_LE(hit.distance, sampled + round_off(10, 4.0));
        EXPECT_GE(hit.distance, sampled - 3.5 / n);
        EXPECT_NEAR(length_between(hit.point, p), hit.distance, round_off(10, 4.0));
        EXPECT_NEAR(
            length_between(p + hit.distance * hit.normal, hit.point), 0.0, round_off(20, 4.0));
        EXPECT_NEAR(sampled_distance(hit.point, corner, n), 0.0, 3.5 / n);
    }
    EXPECT_GT(*std::min_element(seen.begin(), seen.end()), 5) << "a kind of feature was not tried";
}

TEST(ClosestPoint, IsClassifiedByRegion) {
    const Surface surface = single_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const auto feature_at = [&](double x, double y) {
        return hits_of(surface, {x, y, 0.3}, 9.0).at(0);
    };
    EXPECT_EQ(feature_at(0.2, 0.2).feature, Feature::face);
    EXPECT_EQ(feature_at(0.2, 0.2).normal, (Vec3{0.0, 0.0, -1.0}));
    EXPECT_EQ(feature_at(0.5, -1.0).feature, Feature::edge);
    EXPECT_EQ(feature_at(0.5, -1.0).point, (Vec3{0.5, 0.0, 0.0}));
    EXPECT_EQ(feature_at(-1.0, 0.5).point, (Vec3{0.0, 0.5, 0.0}));
    EXPECT_EQ(feature_at(1.0, 1.0).feature, Feature::edge);
    EXPECT_NEAR(
        length_between(feature_at(1.0, 1.0).point, {0.5, 0.5, 0.0}), 0.0, round_off(4, 1.0));
    EXPECT_EQ(feature_at(-1.0, -1.0).feature, Feature::vertex);
    EXPECT_EQ(feature_at(-1.0, -1.0).point, Vec3{});
    EXPECT_EQ(feature_at(2.0, -0.5).point, (Vec3{1.0, 0.0, 0.0}));
    EXPECT_EQ(feature_at(-0.5, 2.0).point, (Vec3{0.0, 1.0, 0.0}));
}

TEST(ClosestPoint, InThePlaneOfAFaceUsesTheNormalOfTheFace) {
    const Surface surface = single_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const WallHit hit = hits_of(surface, {0.25, 0.25, 0.0}, 0.1).at(0);
    EXPECT_EQ(hit.normal, (Vec3{0.0, 0.0, 1.0}));
    EXPECT_EQ(hit.distance, 0.0);
    EXPECT_EQ(hits_of(surface, {1.0, 0.0, 0.0}, 0.1).at(0).normal, (Vec3{0.0, 0.0, 1.0}));
}

TEST(Plane, RepelsOnBothSidesEverywhere) {
    const Surface plane = surface_of(Plane{.point = {0, 0, 1}, .normal = {0, 0, 5}});
    EXPECT_EQ(hits_of(plane, {1e3, -1e3, 1.5}, 1.0).at(0).normal, (Vec3{0, 0, -1}));
    EXPECT_EQ(hits_of(plane, {1e3, -1e3, 0.5}, 1.0).at(0).normal, (Vec3{0, 0, 1}));
    EXPECT_TRUE(hits_of(plane, {0, 0, 2.1}, 1.0).empty());
    EXPECT_EQ(plane.extent_from({}), std::numeric_limits<double>::infinity());
}

TEST(Disc, HasAFaceAndARim) {
    const Surface disc = surface_of(Disc{.centre = {1, 0, 0}, .normal = {0, 0, 1}, .radius = 2.0});
    EXPECT_EQ(hits_of(disc, {2, 1, -0.5}, 1.0).at(0).point, (Vec3{2, 1, 0}));
    const WallHit rim = hits_of(disc, {6, 0, 4}, 6.0).at(0);
    EXPECT_EQ(rim.feature, Feature::edge);
    EXPECT_EQ(rim.point, (Vec3{3, 0, 0}));
    EXPECT_EQ(rim.distance, 5.0);
    EXPECT_NEAR(disc.extent_from({1, 0, 3}), std::sqrt(13.0), round_off(4, 4.0));
}

TEST(Disc, LetsThroughWhatFitsInItsHole) {
    const Surface disc =
        surface_of(Disc{.centre = {1, 0, 0}, .normal = {0, 0, 1}, .radius = 5.0, .hole = 3.0});
    EXPECT_TRUE(hits_of(disc, {1, 0, 0}, 2.9).empty());
    EXPECT_EQ(hits_of(disc, {1, 4, 0.5}, 1.0).at(0).point, (Vec3{1, 4, 0}));
    const WallHit rim = hits_of(disc, {1, 0, 4}, 5.5).at(0);  // on the axis: one contact, somewhere
    EXPECT_EQ(rim.feature, Feature::edge);
    EXPECT_EQ(rim.distance, 5.0);
    const WallHit side = hits_of(disc, {3, 0, 0}, 1.5).at(0);
    EXPECT_EQ(side.point, (Vec3{4, 0, 0}));
    EXPECT_EQ(side.normal, (Vec3{1, 0, 0}));
}

TEST(Cylinder, AgreesWithFineFacets) {
    const Cylinder round{.base = {0.1, -0.2, 0.3}, .axis = {1, 2, 2}, .radius = 0.5, .height = 0.8};
    // Sagitta of the facets: R (1 - cos(q / 2)) with q = 0.02 is 2.5e-5.
    const FacetedCylinder facets{round.base, round.axis, 0.5, 0.8, 0.02, CylinderPart::all};
    const Surface exact = surface_of(round);
    const Surface fine = surface_of(facets);
    RandomPoints random(2);
    int inside = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        const Vec3 p = round.base + random.in_cube(1.2);
        EXPECT_NEAR(exact.distance(p), fine.distance(p), 2.6e-5);
        if (exact.encloses(p, 0.05) && exact.distance(p) > 0.05 + 2.6e-5) {
            ++inside;
            EXPECT_TRUE(fine.encloses(p, 0.05));
        }
        if (!exact.encloses(p, 0.05)) {
            EXPECT_FALSE(fine.encloses(p, 0.05));  // facets are inscribed
        }
    }
    EXPECT_GT(inside, 50);
}

TEST(Cylinder, TouchesOnceAtItsRimFromOutsideAndTwiceInItsCorner) {
    const Surface cylinder = surface_of(Cylinder{.radius = 1.0, .height = 2.0});
    const std::vector<WallHit> rim = hits_of(cylinder, {1.03, 0.0, 2.04}, 0.06);
    ASSERT_EQ(rim.size(), 1U);
    EXPECT_EQ(rim[0].feature, Feature::edge);
    EXPECT_NEAR(rim[0].distance, 0.05, round_off(10, 1.0));
    EXPECT_EQ(rim[0].patch, 0U);
    EXPECT_EQ(hits_of(cylinder, {0.95, 0.0, 1.95}, 0.06).size(), 2U);
    EXPECT_EQ(hits_of(cylinder, {1.05, 0.0, 1.99}, 0.06).size(), 1U);  // side, not the cap's rim
    EXPECT_EQ(hits_of(cylinder, {0.99, 0.0, 2.05}, 0.06).size(), 1U);  // cap, not the side's rim
    EXPECT_EQ(hits_of(cylinder, {0.0, 0.0, 1.0}, 1.5).size(), 3U);     // on the axis
}

TEST(Cylinder, HasOnlyThePartsAskedFor) {
    const auto count = [](CylinderPart part) {
        return surface_of(Cylinder{.part = part}).patch_count();
    };
    EXPECT_EQ(count(CylinderPart::all), 3U);
    EXPECT_EQ(count(CylinderPart::side), 1U);
    EXPECT_EQ(count(CylinderPart::caps), 2U);
    EXPECT_EQ(count(CylinderPart::base), 1U);
    EXPECT_EQ(count(CylinderPart::open_top), 2U);
    const Surface open = surface_of(Cylinder{.part = CylinderPart::open_top});
    EXPECT_EQ(open.distance({0, 0, 0.75}), 0.75);
    EXPECT_TRUE(open.encloses({0, 0, 0.75}, 0.25));
    EXPECT_FALSE(open.encloses({0, 0, 0.875}, 0.25));  // open parts count as closed
}

TEST(ContactRule, GivesOneHitWithoutAStepAcrossACoplanarSeam) {
    const Surface floor = surface_of(BoxShape{{-1, -1, -1}, {1, 1, 0}});
    for (int k = -1000; k <= 1000; ++k) {
        const double x = 0.04 * k / 1000.0;
        const std::vector<WallHit> hits = hits_of(floor, {x, -0.3 * x, 0.9 * ball}, ball);
        ASSERT_EQ(hits.size(), 1U) << "x = " << x;
        EXPECT_NEAR(hits[0].distance, 0.9 * ball, round_off(4, 1.0));
        EXPECT_NEAR(length_between(hits[0].normal, {0, 0, -1}), 0.0, round_off(4, 1.0 / ball));
    }
}

TEST(ContactRule, GivesOneHitAtAVertexOfSixCoplanarTriangles) {
    const Surface floor = surface_of(terrain(4, 4.0 * ball, [](double, double) { return 0.0; }));
    // Offsets from below the merging distance to well above it, in many directions.
    for (const double offset :
         {0.0, 1e-18, 1e-12, 1e-11, 1e-10, 3e-10, 1e-9, 3e-9, 1e-8, 1e-6, 1e-4}) {
        for (int k = 0; k < 360; ++k) {
            const double angle = pi * k / 180.0;
            const Vec3 p{offset * std::cos(angle), offset * std::sin(angle), 0.95 * ball};
            const std::vector<WallHit> hits = hits_of(floor, p, ball);
            ASSERT_EQ(hits.size(), 1U) << offset << " at " << k << " degrees";
            // Points that merge are 1e-6 of the reach apart at most, their distances 1e-12 of it.
            EXPECT_NEAR(hits[0].distance, 0.95 * ball, 1e-12 * ball);
        }
    }
}

TEST(ContactRule, GivesOneHitOverTrianglesMuchFinerThanTheBall) {
    const Surface floor = surface_of(terrain(60, 4.0 * ball, [](double, double) { return 0.0; }));
    RandomPoints random(3);
    for (int trial = 0; trial < 300; ++trial) {
        const Vec3 p{random.between(-ball, ball), random.between(-ball, ball), 0.9 * ball};
        ASSERT_GT(patches_near(floor, p, 1.06 * ball).size(), 64U);
        const std::vector<WallHit> hits = hits_of(floor, p, 1.06 * ball);
        ASSERT_EQ(hits.size(), 1U);
        EXPECT_NEAR(hits[0].distance, 0.9 * ball, round_off(4, ball));
    }
}

TEST(ContactRule, PassesFromFaceToEdgeToFaceOverAConvexEdge) {
    const Surface box = surface_of(BoxShape{{-1, -1, -1}, {0, 1, 0}});
    const double reach = 1.06 * ball;
    for (int k = 0; k <= 2000; ++k) {
        // Along the top, around the edge at x = 0, z = 0, down the side: always 0.9 ball away.
        const double s = 0.04 * k / 2000.0 - 0.02;
        const double r = 0.9 * ball;
        const double turn = std::clamp(s / r, 0.0, 0.5 * pi);
        const double past = std::max(s - 0.5 * pi * r, 0.0);
        const Vec3 p{std::min(s, 0.0) + r * std::sin(turn), 0.123, r * std::cos(turn) - past};
        const std::vector<WallHit> hits = hits_of(box, p, reach);
        ASSERT_EQ(hits.size(), 1U) << "s = " << s;
        EXPECT_NEAR(hits[0].distance, r, round_off(10, 1.0));
        const bool is_at_edge = s > 1e-9 && past == 0.0 && turn < 0.5 * pi;
        if (is_at_edge) {
            EXPECT_EQ(hits[0].feature, Feature::edge);
        }
        if (s < -1e-9 || past > 1e-9) {
            EXPECT_EQ(hits[0].feature, Feature::face);
        }
    }
}

TEST(ContactRule, LetsAllFacesOfAConcaveCornerAct) {
    const Surface box = surface_of(BoxShape{{0, 0, 0}, {1, 1, 1}});
    const std::vector<WallHit> hits = hits_of(box, {0.9 * ball, 0.8 * ball, 0.7 * ball}, ball);
    ASSERT_EQ(hits.size(), 3U);
    for (const WallHit& hit : hits) {
        EXPECT_EQ(hit.feature, Feature::face);
    }
    EXPECT_EQ(hits_of(box, {0.9 * ball, 0.5, 0.7 * ball}, ball).size(), 2U);
    // On the diagonals of all three faces at once.
    EXPECT_EQ(hits_of(box, {0.9 * ball, 0.9 * ball, 0.9 * ball}, ball).size(), 3U);
}

TEST(ContactRule, LetsTheLowestPatchStandForASharedEdge) {
    const Surface box = surface_of(BoxShape{{-1, -1, -1}, {0, 1, 0}});
    const Vec3 p{0.5 * ball, 0.123, 0.5 * ball};
    const std::vector<Index> patches = patches_near(box, p, ball);
    ASSERT_EQ(patches.size(), 2U);
    const std::vector<WallHit> hits = hits_of(box, p, ball);
    ASSERT_EQ(hits.size(), 1U);
    EXPECT_EQ(hits[0].patch, patches[0]);
    EXPECT_TRUE(box.adjacent(patches[0], patches[1]));
}

/// Slow statement of the rule without numbers of edges and vertices: of the closest points of all
/// triangles, those count that no triangle through the same point has a closer point than.
std::vector<Vec3> touching_points(const std::vector<Surface>& triangles,
                                  const Vec3& p,
                                  double reach) {
    std::vector<WallHit> nearest;
    nearest.reserve(triangles.size());
    for (const Surface& triangle : triangles) {
        nearest.push_back(hits_of(triangle, p, 1e9).at(0));
    }
    std::vector<Vec3> points;
    for (const WallHit& hit : nearest) {
        bool counts = hit.distance <= reach;
        for (std::size_t k = 0; counts && k < triangles.size(); ++k) {
            counts = triangles[k].distance(hit.point) > 1e-12 ||
                     length_between(nearest[k].point, hit.point) < 1e-9;
        }
        const bool is_new = std::none_of(points.begin(), points.end(), [&](const Vec3& other) {
            return length_between(other, hit.point) < 1e-9;
        });
        if (counts && is_new) {
            points.push_back(hit.point);
        }
    }
    return points;
}

void expect_rule_holds(const Triangles& mesh, double half_edge, double reach, std::uint64_t seed) {
    const Surface whole = surface_of(mesh);
    std::vector<Surface> triangles;
    for (const auto& t : mesh.triangles) {
        const auto corner = [&](std::size_t k) {
            return mesh.vertices[static_cast<std::size_t>(t[k])];
        };
        triangles.push_back(single_triangle(corner(0), corner(1), corner(2)));
    }
    RandomPoints random(seed);
    std::size_t touched = 0;
    for (int trial = 0; trial < 600; ++trial) {
        const Vec3 p = random.in_cube(half_edge);
        const std::vector<Vec3> expected = touching_points(triangles, p, reach);
        const std::vector<WallHit> hits = hits_of(whole, p, reach);
        ASSERT_EQ(hits.size(), expected.size()) << p.x << ' ' << p.y << ' ' << p.z;
        touched += hits.size();
        for (const Vec3& point : expected) {
            EXPECT_TRUE(std::any_of(hits.begin(), hits.end(), [&](const WallHit& hit) {
                return length_between(hit.point, point) < 1e-9;
            }));
        }
    }
    EXPECT_GT(touched, 200U);
}

TEST(ContactRule, AgreesWithASlowStatementOfItOnRoughGround) {
    RandomPoints random(4);
    const Triangles ground =
        terrain(8, 1.0, [&](double, double) { return random.between(-0.08, 0.08); });
    expect_rule_holds(ground, 0.45, 0.25, 5);
}

TEST(ContactRule, AgreesWithASlowStatementOfItInsideAndOutsideAStar) {
    // Spikes on a cube: every edge of the cube concave, every spike a vertex of convex edges.
    Triangles star{{{-1, -1, -1},
                    {1, -1, -1},
                    {-1, 1, -1},
                    {1, 1, -1},
                    {-1, -1, 1},
                    {1, -1, 1},
                    {-1, 1, 1},
                    {1, 1, 1},
                    {-2, 0, 0},
                    {2, 0, 0},
                    {0, -2, 0},
                    {0, 2, 0},
                    {0, 0, -2},
                    {0, 0, 2}},
                   {}};
    constexpr std::array<std::array<std::int64_t, 5>, 6> spikes{{{0, 4, 6, 2, 8},
                                                                 {1, 3, 7, 5, 9},
                                                                 {0, 1, 5, 4, 10},
                                                                 {2, 6, 7, 3, 11},
                                                                 {0, 2, 3, 1, 12},
                                                                 {4, 5, 7, 6, 13}}};
    for (const auto& s : spikes) {
        for (std::size_t k = 0; k < 4; ++k) {
            star.triangles.push_back({s[k], s[(k + 1) % 4], s[4]});
        }
    }
    expect_rule_holds(star, 2.5, 0.8, 6);
    const Surface surface = surface_of(star);
    EXPECT_TRUE(surface.encloses({0.0, 1.5, 0.0}, 0.1));
    EXPECT_FALSE(surface.encloses({1.4, 1.4, 0.0}, 0.1));
}

TEST(ContactRule, KeepsTheClosestWhenMoreAreTouchedThanFit) {
    // 40 walls side by side, seen from far: every one is a contact of its own.
    Triangles fence;
    for (std::int64_t k = 0; k < 40; ++k) {
        const double x = 0.1 * static_cast<double>(k);
        fence.vertices.insert(fence.vertices.end(), {{x, -9, -9}, {x, 9, -9}, {x, 0, 9}});
        fence.triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
    }
    const std::vector<WallHit> hits = hits_of(surface_of(fence), {4.0, 0, 0}, 5.0);
    ASSERT_EQ(hits.size(), WallHits::capacity);
    for (std::size_t k = 0; k < hits.size(); ++k) {
        EXPECT_EQ(hits[k].patch, 24 + k);
    }
}

}  // namespace
}  // namespace grainbench
