#include "tests/support/scenes.hpp"
#include "tests/unit/core/measure_support.hpp"

#include <limits>
#include <map>

namespace grainbench::test {
namespace {

/// Round-off of a few dozen operations on numbers of order one.
constexpr double round_off = 64 * std::numeric_limits<double>::epsilon();

// Coordination ------------------------------------------------------------------------------------

/// Four spheres of which each touches the others, a fifth that touches the first of them alone, and
/// a sixth far away that touches the floor alone.
Scene tetrahedron() {
    const double edge = 1.99 * radius;
    const double a = edge / std::sqrt(8.0);
    const double out = edge / std::sqrt(3.0);
    Scene scene = still_scene({{a, a, a},
                               {a, -a, -a},
                               {-a, a, -a},
                               {-a, -a, a},
                               {a + out, a + out, a + out},
                               {0.2, 0.0, 0.0}});
    scene.walls = {floor_at({0.2 + 0.995 * radius, 0.0, 0.0}, {1.0, 0.0, 0.0})};
    return scene;
}

TEST(Coordination, CountsPairsTwiceAndWallsOnceOrNotAtAll) {
    Scene scene = tetrahedron();
    scene.observables.coordination = CoordinationObservable{.walls = true, .least_contacts = 4};
    EXPECT_EQ(measured(scene, "coordination"), (2.0 * 7.0 + 1.0) / 6.0);
    scene.observables.coordination->walls = false;
    EXPECT_EQ(measured(scene, "coordination"), 2.0 * 7.0 / 6.0);
}

TEST(Coordination, MechanicalNumberIsThorntonsWhereTwoContactsHold) {
    Scene scene = tetrahedron();
    scene.observables.coordination = CoordinationObservable{.walls = false, .least_contacts = 2};
    // (2 C - N_1) / (N - N_0 - N_1)
    EXPECT_EQ(measured(scene, "coordination_mechanical"), (2.0 * 7.0 - 1.0) / (6.0 - 1.0 - 1.0));
    EXPECT_EQ(measured(scene, "rattler_fraction"), 2.0 / 6.0);
    scene.observables.coordination->least_contacts = 4;
    EXPECT_EQ(measured(scene, "coordination_mechanical"), 4.0);
    EXPECT_EQ(measured(scene, "rattler_fraction"), 5.0 / 6.0);
}

TEST(Coordination, OfNothingIsNoNumber) {
    Scene scene = still_scene({});
    scene.observables.coordination = CoordinationObservable{};
    EXPECT_TRUE(std::isnan(measured(scene, "coordination")));
    EXPECT_TRUE(std::isnan(measured(scene, "coordination_mechanical")));
}

// Regions -----------------------------------------------------------------------------------------

TEST(Regions, CountCentresInBoxesWithTheirMassAndKinds) {
    Scene scene = still_scene({{0, 0, 0}, {0.1, 0, 0}, {0.2, 0, 0}, {0.3, 0, 0}}, 2);
    scene.observables.regions = {
        {.name = "part", .shape = BoxShape{{0.05, -1, -1}, {0.2, 1, 1}}, .by = CountBy::species},
        {.name = "all", .shape = BoxShape{{-1, -1, -1}, {1, 1, 1}}, .by = CountBy::group}};
    scene.groups.pop_back();  // what is in no group still counts as a particle
    EXPECT_EQ(measured(scene, "part.count"), 2.0);  // a face belongs to the box
    EXPECT_NEAR(measured(scene, "part.mass"), 2.0 * mass, round_off * mass);
    EXPECT_EQ(measured(scene, "part.count.a"), 1.0);
    EXPECT_EQ(measured(scene, "part.count.b"), 1.0);
    EXPECT_EQ(measured(scene, "all.count"), 4.0);
    EXPECT_EQ(measured(scene, "all.count.a"), 2.0);
}

TEST(Regions, CountCentresInATiltedCylinder) {
    // About the diagonal from the origin, radius 0.1, height 0.5.
    const Vec3 axis = normalized({1, 1, 0});
    const Vec3 across = normalized({1, -1, 0});
    Scene scene = still_scene({0.25 * axis + 0.099 * across,
                               0.25 * axis - 0.101 * across,
                               -0.001 * axis,
                               0.499 * axis,
                               0.53 * axis});
    scene.observables.regions = {
        {.name = "hopper",
         .shape = CylinderRegion{.base = {}, .axis = {3, 3, 0}, .radius = 0.1, .height = 0.5},
         .by = {}}};
    EXPECT_EQ(measured(scene, "hopper.count"), 2.0);
}

// Mixing ------------------------------------------------------------------------------------------

constexpr double cell = 10.0 * radius;

/// A place within a cell that no other particle of it has.
Vec3 place_in_cell(int number, int k) {
    return {number * cell + (1.5 + 3.0 * (k % 3)) * radius,
            (1.5 + 3.0 * (k / 3)) * radius,
            1.5 * radius};
}

/// Spheres of which those of `first` are of species a, in cells that hold so many.
Scene dealt(const std::vector<int>& filling, const std::vector<bool>& first) {
    std::vector<Vec3> a;
    std::vector<Vec3> b;
    std::size_t n = 0;
    for (std::size_t c = 0; c < filling.size(); ++c) {
        for (int k = 0; k < filling[c]; ++k) {
            (first[n++] ? a : b).push_back(place_in_cell(static_cast<int>(c) - 1, k));
        }
    }
    const std::size_t count_of_a = a.size();
    a.insert(a.end(), b.begin(), b.end());
    Scene scene = still_scene(a, count_of_a);
    scene.observables.mixing = MixingObservable{.first = "a", .second = "b", .cell = cell};
    return scene;
}

TEST(Mixing, IsNoneWhereEveryCellHoldsOneGroup) {
    const Scene scene = dealt({4, 2}, {true, true, true, true, false, false});
    EXPECT_NEAR(measured(scene, "mixing_index"), 0.0, round_off);
    EXPECT_NEAR(measured(scene, "segregation_intensity"), 1.0, round_off);
    EXPECT_EQ(measured(scene, "mixing_cells"), 2.0);
}

TEST(Mixing, IsMoreThanRandomWhereAllCellsAreAlike) {
    const Scene scene = dealt({2, 2}, {true, false, true, false});
    // s = 0 and s_r^2 = s_0^2 (2 - 1) / (4 - 1)
    EXPECT_NEAR(measured(scene, "mixing_index"), 1.5, round_off);
    EXPECT_NEAR(measured(scene, "segregation_intensity"), 0.0, round_off);
}

TEST(Mixing, IsOneOnTheMeanOfAllWaysToDealHoweverCellsAreFilled) {
    for (const std::vector<int>& filling : {std::vector{2, 2}, {1, 3}, {1, 2, 3}, {5, 1, 1}}) {
        std::size_t count = 0;
        for (const int n : filling) {
            count += static_cast<std::size_t>(n);
        }
        std::vector<bool> first(count, false);
        std::fill(first.end() - 2, first.end(), true);  // the first of all permutations
        double sum = 0.0;
        int ways = 0;
        do {
            sum += measured(dealt(filling, first), "mixing_index");
            ++ways;
        } while (std::next_permutation(first.begin(), first.end()));
        EXPECT_NEAR(sum / ways, 1.0, round_off) << filling[0] << " in the first cell";
    }
}

TEST(Mixing, OfLoneParticlesOrOneGroupIsNoNumber) {
    EXPECT_TRUE(std::isnan(measured(dealt({1, 1, 1}, {true, false, true}), "mixing_index")));
    EXPECT_TRUE(std::isnan(measured(dealt({2, 1}, {true, true, true}), "mixing_index")));
    EXPECT_TRUE(std::isnan(measured(dealt({}, {}), "segregation_intensity")));
}

// Angle of repose ---------------------------------------------------------------------------------

/// Spheres on a square lattice under a surface z = height(x, y), and others below them.
template <class Height>
Scene covered_by(Height height) {
    std::vector<Vec3> positions;
    constexpr double spacing = 3.0 * radius;
    for (int i = -8; i <= 8; ++i) {
        for (int j = -8; j <= 8; ++j) {
            const double x = spacing * i + 0.1 * radius;
            const double y = spacing * j + 0.1 * radius;
            positions.push_back({x, y, height(x, y) - spacing});
            positions.push_back({x, y, height(x, y)});
        }
    }
    return still_scene(positions);
}

TEST(Repose, OfAConeIsItsAngle) {
    constexpr double angle = 27.0;
    const double slope = std::tan(angle * pi / 180.0);
    const Vec3 centre{0.02, -0.01, 0.0};
    Scene scene = covered_by(
        [&](double x, double y) { return 0.7 - slope * std::hypot(x - centre.x, y - centre.y); });
    for (const double column : {2.0 * radius, 5.0 * radius, 9.0 * radius}) {
        scene.observables.repose = {
            {.name = "surface",
             .surface = HeapSurface{.centre = centre, .inner = 0.02, .outer = 0.15},
             .cell = column}};
        EXPECT_NEAR(measured(scene, "surface.angle"), angle, 1e2 * round_off);
        EXPECT_NEAR(measured(scene, "surface.residual"), 0.0, round_off);
    }
}

TEST(Repose, OfASlopeIsPositiveUpAndItsResidualIsTheRoughness) {
    constexpr double angle = -12.0;
    const double slope = std::tan(angle * pi / 180.0);
    Scene scene = covered_by([&](double x, double) { return slope * x; });
    scene.observables.repose = {
        {.name = "surface",
         .surface = SlopeSurface{.along = {1, 0, 5}, .from = -0.2, .to = 0.2},
         .cell = 3.0 * radius}};
    EXPECT_NEAR(measured(scene, "surface.angle"), angle, 1e2 * round_off);
    EXPECT_NEAR(measured(scene, "surface.residual"), 0.0, round_off);
    scene = covered_by([&](double x, double y) {
        // Alternately up and down across the slope: no fit can tell the height from a plane.
        const auto row = std::lround((y - 0.1 * radius) / (3.0 * radius));
        return slope * x + (row % 2 == 0 ? 1.0 : -1.0) * 1e-3;
    });
    scene.observables.repose = {
        {.name = "surface",
         .surface = SlopeSurface{.along = {1, 0, 0}, .from = -0.2, .to = 0.2},
         .cell = 3.0 * radius}};
    EXPECT_NEAR(measured(scene, "surface.angle"), angle, 1e2 * round_off);
    // 9 rows up, 8 down: the variance is 1 - (1/17)^2 of the square of the bump.
    EXPECT_NEAR(measured(scene, "surface.residual"), 1e-3 * std::sqrt(1.0 - 1.0 / 289.0), 1e-12);
}

TEST(Repose, IsMeasuredAgainstGravity) {
    // Up is x: the surface rises by 30 degrees along z.
    std::vector<Vec3> positions;
    for (int k = 0; k < 8; ++k) {
        positions.push_back({0.04 * k * std::tan(pi / 6.0), 0.0, 0.04 * k});
    }
    Scene scene = still_scene(positions);
    scene.gravity = Vec3{-9.8, 0.0, 0.0};
    scene.observables.repose = {
        {.name = "surface",
         .surface = SlopeSurface{.along = {0, 0, 1}, .from = -1.0, .to = 1.0},
         .cell = 2.0 * radius}};
    EXPECT_NEAR(measured(scene, "surface.angle"), 30.0, 1e2 * round_off);
}

TEST(Repose, OfTwoColumnsIsNoNumber) {
    Scene scene = still_scene({{0, 0, 0}, {0.1, 0, 0}});
    scene.observables.repose = {{.name = "surface",
                                 .surface = HeapSurface{.centre = {}, .inner = 0.0, .outer = 1.0},
                                 .cell = 2.0 * radius}};
    EXPECT_TRUE(std::isnan(measured(scene, "surface.angle")));
}

// Contact network ---------------------------------------------------------------------------------

TEST(ContactFrame, ForcesAddUpToThoseOnTheParticles) {
    Scene scene = thrown_bed();
    Simulation simulation(scene, 0);
    Observer nobody;
    simulation.advance(1500, nobody);
    const ParticleFrame particles = simulation.particle_frame();
    const ContactFrame contacts = simulation.contact_frame();
    std::map<std::int64_t, std::size_t> place;
    for (std::size_t k = 0; k < particles.size(); ++k) {
        place[particles.id[k]] = k;
    }
    std::vector<Vec3> sum(particles.size());
    double largest = 0.0;
    std::size_t with_walls = 0;
    for (std::size_t k = 0; k < contacts.i_id.size(); ++k) {
        const std::size_t i = place.at(contacts.i_id[k]);
        sum[i] -= contacts.force[k];
        largest = std::max(largest, norm(contacts.force[k]));
        EXPECT_EQ(contacts.i_species[k], particles.species[i]);
        if (contacts.wall[k] == 0) {
            const std::size_t j = place.at(contacts.j_id[k]);
            sum[j] += contacts.force[k];
            EXPECT_EQ(contacts.j_species[k], particles.species[j]);
            const Vec3 apart = particles.position[j] - particles.position[i];
            EXPECT_LT(norm(apart - contacts.branch[k]), round_off * norm(apart));
        } else {
            ++with_walls;
            EXPECT_EQ(contacts.j_species[k], -1);
            EXPECT_LT(norm(particles.position[i] + contacts.branch[k] - contacts.point[k]),
                      round_off * particles.radius[i]);
        }
    }
    ASSERT_GT(contacts.i_id.size(), 100U);
    ASSERT_GT(with_walls, 10U);
    for (std::size_t k = 0; k < particles.size(); ++k) {
        EXPECT_LT(norm(sum[k] - particles.force[k]), round_off * largest);
    }
}

/// Counts frames, and the contacts in them.
class ContactCounter : public Observer {
public:
    void on_frame(const Simulation& simulation) override {
        ++frames;
        contacts += simulation.contact_frame().overlap.size();
    }

    int frames = 0;
    std::size_t contacts = 0;
};

TEST(ContactFrame, IsThereWhereOneIsDueAndOnlyThereIsPaidFor) {
    Scene scene = thrown_bed();
    scene.observables.energy.reset();
    scene.guards.energy.action = GuardAction::ignore;  // looks at forces of contacts, too
    scene.output.contacts = true;
    scene.output.frame_interval = 0.006;
    Simulation simulation(scene, 0);
    ContactCounter counter;
    int cycles_with = 0;
    while (!simulation.advance(1, counter)) {
        const int before = counter.frames;
        try {
            static_cast<void>(simulation.contact_frame());
            ++cycles_with;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::bad_input);
        }
        ASSERT_EQ(counter.frames, before);
    }
    // At the start, after every 6 ms of the stages of 30 and 10 ms, and at the end.
    EXPECT_EQ(counter.frames, 8);
    EXPECT_GT(counter.contacts, 100U);
    // The last cycle of the first stage, and the frames but the first and the last.
    EXPECT_LE(cycles_with, 8);
}

}  // namespace
}  // namespace grainbench::test
