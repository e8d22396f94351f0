/// Sinks and sources: who goes, who comes, and that the others do not feel it.
#include "core/engine.hpp"

#include "tests/support/observers.hpp"
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace grainbench::test {
namespace {

constexpr std::uint64_t cycles_between_looks = 64;

double now(const Simulation& simulation, const std::string& name) {
    const auto& columns = simulation.history_columns();
    const auto at = std::find_if(
        columns.begin(), columns.end(), [&](const auto& column) { return column.name == name; });
    EXPECT_NE(at, columns.end()) << name;
    return simulation.history_row().at(static_cast<std::size_t>(at - columns.begin()));
}

void finish(Simulation& simulation) {
    Observer nobody;
    simulation.advance(1U << 30, nobody);
}

Scene falling_column(double duration) {
    Scene scene;
    scene.gravity = Vec3{0.0, 0.0, -9.8};
    scene.particles.species = {{"ball", 0.003, 1500.0}};
    scene.particles.insertion = {LatticeInsertion{.species = "ball",
                                                  .origin = {0.0, 0.0, 0.1},
                                                  .spacing = {0.0, 0.0, 0.01},
                                                  .counts = {1, 1, 5}}};
    scene.contact = full_contact(1e4, 0.2);
    scene.timestep = FixedTimestep{1e-5};
    Stage stage;
    stage.duration = duration;
    scene.stages = {stage};
    return scene;
}

TEST(Sink, DeletesAndCountsWhatFallsIntoIt) {
    // Heights 0.10 to 0.14 m fall to 0 in 0.143, 0.150, 0.156, 0.163, 0.169 s.
    Scene scene = falling_column(0.16);
    scene.particles.sinks = {{.name = "outlet", .high = 0.0, .box = {}}};
    Simulation simulation(scene, 0);
    finish(simulation);
    EXPECT_EQ(now(simulation, "outlet.count"), 3.0);
    EXPECT_EQ(now(simulation, "particles"), 2.0);
    EXPECT_DOUBLE_EQ(now(simulation, "outlet.mass"), 3.0 * sphere_mass(1500.0, 0.003));
    EXPECT_EQ(simulation.particle_frame().id, (std::vector<std::int64_t>{4, 5}));
}

TEST(Sink, CatchesInItsBoxAlone) {
    Scene scene = falling_column(0.2);
    scene.particles.sinks = {
        {.name = "beside", .high = 0.0, .box = Box{{0.01, -1.0, -1.0}, {1.0, 1.0, 1.0}}}};
    Simulation simulation(scene, 0);
    finish(simulation);
    EXPECT_EQ(now(simulation, "beside.count"), 0.0);
    EXPECT_EQ(simulation.particle_count(), 5U);
}

/// The bed, with history in all its contacts, must go on as if the ball had never been: exact, for
/// slots that stay keep their order and so do sums.
TEST(Sink, LeavesTheContactsOfTheOthersAsTheyAre) {
    Scene without = thrown_bed();
    without.timestep = FixedTimestep{5e-6};
    without.stages.resize(1);
    without.observables = {};
    without.traces = {};
    without.groups = {};
    Scene with = without;
    // Not so high that it would turn the order of slots.
    with.particles.insertion.push_back(
        ListInsertion{.particles = {{.species = "small", .position = {0.0, 0.0, 0.004}}}});
    with.particles.sinks = {{.name = "top", .low = 0.002, .box = {}}};
    Simulation bed(without, 0);
    Simulation visited(with, 0);
    finish(bed);
    finish(visited);
    ASSERT_EQ(now(visited, "top.count"), 1.0);
    EXPECT_GT(bed.touching_count(), 20U);
    EXPECT_EQ(bed.particle_frame().position, visited.particle_frame().position);
    EXPECT_EQ(bed.particle_frame().angular_velocity, visited.particle_frame().angular_velocity);
}

Scene shower(double rate, double duration) {
    Scene scene = falling_column(duration);
    scene.particles.insertion = {};
    scene.particles.sources = {{.name = "inlet",
                                .species = "ball",
                                .box = {{-0.02, -0.02, 0.1}, {0.02, 0.02, 0.12}},
                                .rate = rate,
                                .count = {},
                                .velocity = {0.0, 0.0, -1.0},
                                .end = {}}};
    return scene;
}

TEST(Source, LetsInItsRateWithoutOverlap) {
    constexpr double rate = 1000.0;
    constexpr double dt = 1e-5;
    Scene scene = shower(rate, 0.1);
    Simulation simulation(scene, 0);
    Observer nobody;
    for (int look = 0; look < 150; ++look) {
        simulation.advance(cycles_between_looks, nobody);
        const double count = now(simulation, "inlet.count");
        // One at the start; up to a look late.
        EXPECT_LE(count, std::floor(rate * simulation.time()) + 1.0);
        EXPECT_GE(count, std::floor(rate * (simulation.time() - cycles_between_looks * dt)));
        EXPECT_EQ(count, static_cast<double>(simulation.particle_count()));
    }
    EXPECT_EQ(simulation.summary().late_contacts, 0U);
    // Spheres that run into each other, at a hundredth of the speed of the fall, overlap by far
    // less.
    EXPECT_LT(simulation.summary().largest_overlap_ratio, 0.05);
}

TEST(Source, StopsAtItsCountAndAtItsEnd) {
    Scene scene = shower(1000.0, 0.1);
    scene.particles.sources[0].count = 7;
    Simulation counted(scene, 0);
    finish(counted);
    EXPECT_EQ(now(counted, "inlet.count"), 7.0);
    scene = shower(1000.0, 0.1);
    scene.particles.sources[0].start = 0.02;
    scene.particles.sources[0].end = 0.0305;
    Simulation ended(scene, 0);
    finish(ended);
    EXPECT_EQ(now(ended, "inlet.count"), 11.0);  // at 20, 21, ... 30 ms
}

/// A box with room for one: each waits until the one before has fallen out of its way.
TEST(Source, WaitsForRoom) {
    Scene scene = shower(1e4, 0.2);
    scene.particles.sources[0].box = {{-0.003, -0.003, 0.1}, {0.003, 0.003, 0.106}};
    scene.particles.sources[0].velocity = {0.0, 0.0, -0.5};
    Simulation simulation(scene, 0);
    finish(simulation);
    EXPECT_GT(now(simulation, "inlet.count"), 10.0);
    EXPECT_LT(now(simulation, "inlet.count"), 100.0);
    EXPECT_EQ(simulation.summary().late_contacts, 0U);
}

/// What comes and goes while it touches nothing is no error of the ledger; nothing else is left in
/// the residual than in a closed scene (half of dt^2 g F / m at 1e-5 s, below 1e-9 J here).
TEST(Traffic, KeepsTheLedgerClosed) {
    Scene scene = shower(500.0, 0.3);
    scene.observables.energy = EnergyObservable{};
    scene.walls = {{.name = "floor",
                    .shape = Disc{.centre = {0.0, 0.0, 0.0}, .radius = 0.015},
                    .motion = FixedMotion{},
                    .material = {}}};
    scene.particles.sinks = {{.name = "below", .high = -0.05, .box = {}}};
    Simulation simulation(scene, 0);
    finish(simulation);
    ASSERT_GT(now(simulation, "below.count"), 20.0);
    EXPECT_GT(now(simulation, "energy_dissipated_dashpot"), 1e-5);
    EXPECT_LT(std::abs(now(simulation, "energy_residual")), 1e-9);
}

/// Newcomers bring energy that no wall supplied: no trouble of the integration.
TEST(Traffic, IsNoTroubleToTheGuards) {
    Scene scene = shower(2000.0, 0.2);
    scene.particles.sources[0].velocity = {0.0, 0.0, -3.0};
    scene.particles.sinks = {{.name = "below", .high = -0.1, .box = {}}};
    scene.timestep = AutomaticTimestep{};
    Simulation simulation(scene, 0);
    finish(simulation);
    EXPECT_GT(now(simulation, "below.count"), 100.0);
    EXPECT_TRUE(simulation.summary().warnings.empty());
}

TEST(Traffic, KeepsGroupsAndTracesWithTheirParticles) {
    Scene scene = falling_column(0.16);
    scene.particles.species.push_back({"guest", 0.002, 1500.0});
    scene.particles.sources = {{.name = "inlet",
                                .species = "guest",
                                .box = {{0.05, 0.0, 0.5}, {0.06, 0.01, 0.6}},
                                .rate = 100.0,
                                .count = {},
                                .end = {}}};
    scene.particles.sinks = {{.name = "outlet", .high = 0.0, .box = {}}};
    scene.groups = {
        {.name = "top", .species = {}, .box = Box{{-1.0, -1.0, 0.135}, {1.0, 1.0, 0.2}}},
        {.name = "guests", .species = "guest", .box = {}}};
    scene.traces = {{.nearest_to = {0.0, 0.0, 0.1}, .species = {}},
                    {.nearest_to = {0.0, 0.0, 0.14}, .species = {}}};
    Simulation simulation(scene, 0);
    finish(simulation);
    const ParticleFrame frame = simulation.particle_frame();
    ASSERT_GT(frame.size(), 3U);
    EXPECT_EQ(frame.id[0], 4);
    EXPECT_EQ(frame.group[0], 0);
    EXPECT_EQ(frame.group[1], 1);
    EXPECT_EQ(frame.group[2], 2);
    ASSERT_EQ(simulation.trace_points().size(), 1U);
    EXPECT_EQ(simulation.trace_points()[0].id, 5);
}

}  // namespace
}  // namespace grainbench::test
