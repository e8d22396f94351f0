/// Threads and slices decide who steps a realisation and when, never what comes out.
#include "core/ensemble.hpp"

#include "tests/support/observers.hpp"
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <set>

namespace grainbench::test {
namespace {

struct Outcome {
    std::vector<std::uint64_t> hashes;
    std::vector<std::vector<std::vector<std::uint64_t>>> rows;
    std::vector<std::vector<std::vector<std::uint64_t>>> traces;

    friend bool operator==(const Outcome&, const Outcome&) = default;
};

Outcome run(const Scene& scene, const EnsembleOptions& options) {
    std::vector<Simulation> simulations;
    std::vector<Recorder> recorders(static_cast<std::size_t>(scene.realisations.count));
    std::vector<Observer*> observers;
    for (int n = 0; n < scene.realisations.count; ++n) {
        simulations.emplace_back(scene, n);
        observers.push_back(&recorders[static_cast<std::size_t>(n)]);
    }
    const std::atomic<bool> stop{false};
    run_ensemble(simulations, observers, options, stop, {});
    Outcome outcome;
    for (std::size_t n = 0; n < simulations.size(); ++n) {
        EXPECT_TRUE(simulations[n].finished());
        outcome.hashes.push_back(simulations[n].state_hash());
        outcome.rows.push_back(recorders[n].rows);
        outcome.traces.push_back(recorders[n].traces);
    }
    return outcome;
}

TEST(Threads, NeitherTheirNumberNorTheSliceChangesABit) {
    Scene scene = thrown_bed();
    scene.stages[0].duration = 0.021;
    scene.stages[1].duration = 0.006;
    const Outcome expected = run(scene, {.threads = 1, .slice = 100});
    ASSERT_GT(expected.rows[0].size(), 10U);
    ASSERT_GT(expected.traces[0].size(), 100U);
    for (const unsigned threads : {1U, 2U, 4U}) {
        for (const std::uint64_t slice : {100U, 7U}) {
            EXPECT_EQ(run(scene, {.threads = threads, .slice = slice}), expected)
                << threads << " threads, slices of " << slice;
        }
    }
}

/// More slabs than one has, by a lattice in touch that falls and is thrown against its box.
Scene long_bed() {
    constexpr double radius = 0.003;
    ListInsertion list;
    for (int n = 0; n < 12000; ++n) {
        Placement sphere{.species = "small",
                         .position = {radius * (2.0 * (n % 10) + 1.0),
                                      radius * (2.0 * (n / 10 % 10) + 1.0),
                                      radius * (2.0 * (n / 100) + 1.0)}};
        sphere.velocity = {
            0.3 * std::sin(1.7 * n), 0.3 * std::sin(2.3 * n), 0.3 * std::sin(3.1 * n)};
        list.particles.push_back(sphere);
    }
    Scene scene;
    scene.gravity = Vec3{0.0, 0.0, -9.8};
    scene.particles.species = {{"small", radius, 1500.0}};
    scene.particles.insertion = {std::move(list)};
    scene.walls = {{.name = "box",
                    .shape = BoxShape{{0.0, 0.0, 0.0}, {0.06, 0.06, 0.75}},
                    .motion = FixedMotion{},
                    .material = {}}};
    scene.contact = full_contact(1e5, 0.3);
    Stage stage;
    stage.duration = 1.0;
    scene.stages = {stage};
    return scene;
}

/// Lets as many threads run as are asked for, on machines with fewer processors too.
struct Crowd {
    tbb::global_control allowed{tbb::global_control::max_allowed_parallelism, 8};
};

TEST(Threads, ThoseInsideOneSceneChangeNoBit) {
    const Crowd crowd;
    const Scene scene = long_bed();
    Observer nobody;
    Simulation alone(scene, 0);
    alone.advance(300, nobody);
    ASSERT_GT(alone.touching_count(), 5000U);
    for (const unsigned threads : {2U, 3U, 8U}) {
        Simulation shared(scene, 0, {.isa = "", .threads = threads});
        shared.advance(300, nobody);
        EXPECT_EQ(shared.state_hash(), alone.state_hash()) << threads << " threads";
    }
}

TEST(Threads, ThoseInASceneWhoseSlotsAreSortedAnewChangeNoBit) {
    const Crowd crowd;
    const Scene scene = mixing_gas();
    Observer nobody;
    Simulation alone(scene, 0);
    alone.advance(700, nobody);
    for (const unsigned threads : {2U, 3U, 8U}) {
        Simulation shared(scene, 0, {.isa = "", .threads = threads});
        shared.advance(700, nobody);
        EXPECT_EQ(shared.state_hash(), alone.state_hash()) << threads << " threads";
    }
}

TEST(Threads, ThoseOfARestartChangeNoBit) {
    const Crowd crowd;
    const Scene scene = long_bed();
    Observer nobody;
    Simulation straight(scene, 0, {.isa = "", .threads = 2});
    straight.advance(150, nobody);
    Archive archive;
    straight.save(archive);
    straight.advance(100, nobody);
    for (const unsigned threads : {1U, 2U, 4U, 8U}) {
        Simulation resumed(scene, 0, {.isa = "", .threads = threads});
        resumed.load(archive);
        resumed.advance(100, nobody);
        EXPECT_EQ(resumed.state_hash(), straight.state_hash()) << threads << " threads";
    }
}

TEST(Threads, RealisationsDifferFromEachOther) {
    const Scene scene = thrown_bed();
    std::set<std::uint64_t> hashes;
    for (int n = 0; n < 3; ++n) {
        hashes.insert(Simulation(scene, n).state_hash());
    }
    EXPECT_EQ(hashes.size(), 3U);
}

}  // namespace
}  // namespace grainbench::test
