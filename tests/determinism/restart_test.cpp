/// A run that was saved, forgotten and loaded again goes on to the same bits.
#include "core/simulation.hpp"

#include "tests/support/observers.hpp"
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <span>

namespace grainbench::test {
namespace {

/// Names of the columns of two archives whose bytes differ.
std::string differences(const Archive& a, const Archive& b) {
    std::string names;
    for (const auto& [name, column] : a.columns()) {
        std::visit(
            [&, key = name](const auto& values) {
                using Values = std::decay_t<decltype(values)>;
                const auto& others = b.get<typename Values::value_type>(key);
                // Bytes, so that zeros of both signs and numbers that are none count as they are.
                const auto bytes = std::as_bytes(std::span(values));
                if (!std::ranges::equal(bytes, std::as_bytes(std::span(others)))) {
                    names += " " + key;
                }
            },
            column);
    }
    return names;
}

Archive saved(const Simulation& simulation) {
    Archive archive;
    simulation.save(archive);
    return archive;
}

struct Moment {
    std::uint64_t cycle;
    std::size_t stage;
};

/// Saves at each moment, goes on in a new simulation, and compares with the straight run.
void expect_same_after_restart(const Scene& scene, const std::vector<Moment>& moments) {
    Recorder straight_record;
    Simulation straight(scene, 0);
    const std::vector<Vec3> still = straight.wall_frame().walls.at(0).points;
    straight.advance(1U << 30, straight_record);
    for (const auto& [cycle, stage] : moments) {
        SCOPED_TRACE("saved at cycle " + std::to_string(cycle));
        Recorder record;
        Archive archive;
        {
            Simulation first(scene, 0);
            ASSERT_FALSE(first.advance(cycle, record));
            ASSERT_EQ(first.stage(), stage);
            ASSERT_GT(first.touching_count(), 10U);
            ASSERT_NE(first.wall_frame().walls.at(0).points, still);
            first.save(archive);
        }
        Simulation second(scene, 0);
        second.load(archive);
        EXPECT_EQ(differences(archive, saved(second)), "");
        EXPECT_TRUE(second.advance(1U << 30, record));
        EXPECT_EQ(second.cycle(), straight.cycle());
        EXPECT_EQ(differences(saved(straight), saved(second)), "");
        EXPECT_EQ(second.state_hash(), straight.state_hash());
        EXPECT_EQ(record.rows, straight_record.rows);
        EXPECT_EQ(record.traces, straight_record.traces);
        EXPECT_EQ(record.fields, straight_record.fields);
    }
}

TEST(Restart, ContinuesToTheSameBits) {
    expect_same_after_restart(thrown_bed(), {{1401, 0}, {1899, 0}, {2300, 1}, {2450, 1}});
}

TEST(Restart, ContinuesToTheSameBitsWhereSlotsAreSortedAnew) {
    const Scene scene = mixing_gas();
    Observer nobody;
    Simulation straight(scene, 0);
    const Archive at_start = saved(straight);
    straight.advance(500, nobody);
    const Archive archive = saved(straight);
    ASSERT_NE(at_start.get<std::uint64_t>("particles/id"),
              archive.get<std::uint64_t>("particles/id"));
    Simulation resumed(scene, 0);
    resumed.load(archive);
    EXPECT_EQ(differences(archive, saved(resumed)), "");
    straight.advance(1U << 30, nobody);
    resumed.advance(1U << 30, nobody);
    EXPECT_EQ(differences(saved(straight), saved(resumed)), "");
    ASSERT_NE(archive.get<std::uint64_t>("particles/id"),
              saved(straight).get<std::uint64_t>("particles/id"));
}

TEST(Restart, ContinuesToTheSameBitsAcrossPeriodicBoundaries) {
    expect_same_after_restart(carried_bed(), {{2001, 0}, {7777, 0}});
    Scene scene = with_traffic(carried_bed());
    scene.particles.sinks[0].box = Box{{0.02, 0.0, 0.009}, {1.0, 1.0, 1.0}};  // off the top
    expect_same_after_restart(scene, {{5505, 0}, {7777, 0}});
}

TEST(Restart, ContinuesToTheSameBitsWhereParticlesComeAndGo) {
    // 1409 is the cycle of a look: what changed in it has not been searched for yet.
    expect_same_after_restart(with_traffic(thrown_bed()), {{1401, 0}, {1409, 0}, {2300, 1}});
}

TEST(Restart, ContinuesToTheSameBitsWithASearchEveryFewCycles) {
    Scene scene = thrown_bed();
    scene.detection.trigger = RemapInterval{10};
    expect_same_after_restart(scene, {{1402, 0}, {2405, 1}});
}

TEST(Restart, ContinuesToTheSameBitsInATurningContainer) {
    Scene scene = thrown_bed();
    const RotationMotion turning{.point = {0.0, 0.0, 0.0}, .axis = {1.0, 0.2, 0.0}, .rate = 30.0};
    scene.stages[0].motions = {{"container", turning}};
    expect_same_after_restart(scene, {{1402, 0}});
}

TEST(Restart, ContinuesToTheSameBitsWhereInertiaWasScaled) {
    Scene scene = thrown_bed();
    scene.stages[0].timestep = ScaledTimestep{.value = 2e-5};
    scene.stages[1].timestep = AutomaticTimestep{};
    expect_same_after_restart(scene, {{1400, 0}, {1700, 1}});
}

TEST(Restart, ContinuesToTheSameRowsAndFieldsOfAllObservables) {
    Scene scene = thrown_bed();
    Observables& wanted = scene.observables;
    wanted.energy.reset();
    wanted.coordination = CoordinationObservable{};
    wanted.regions = {{.name = "low",
                       .shape = BoxShape{{-1.0, -1.0, -1.0}, {1.0, 1.0, -0.01}},
                       .by = CountBy::group}};
    wanted.mixing = MixingObservable{.first = "small", .second = "large", .cell = 0.01};
    wanted.repose = {{.name = "surface",
                      .surface = HeapSurface{.centre = {}, .inner = 0.0, .outer = 0.02},
                      .cell = 0.006}};
    wanted.coarse_graining =
        CoarseGrainingObservable{.box = {{-0.02, -0.02, -0.03}, {0.02, 0.02, 0.03}},
                                 .counts = {2, 2, 3},
                                 .kernel = Kernel::lucy,
                                 .reach = 0.01};
    scene.output.field_interval = 0.0007;
    expect_same_after_restart(scene, {{1401, 0}, {2300, 1}});
}

/// Each leg begins in a new simulation with what the straight run had there, so that a difference
/// cannot hide behind the next saved state.
TEST(Restart, ContinuesToTheSameBitsFromLegToLeg) {
    constexpr std::uint64_t leg = 97;
    const Scene scene = thrown_bed();
    Recorder straight_record;
    Simulation straight(scene, 0);
    std::vector<Archive> states;
    std::vector<std::size_t> rows;
    while (!straight.advance(leg, straight_record)) {
        states.push_back(saved(straight));
        rows.push_back(straight_record.rows.size());
    }
    states.push_back(saved(straight));
    rows.push_back(straight_record.rows.size());
    ASSERT_GT(states.size(), 20U);
    for (std::size_t k = 0; k + 1 < states.size(); ++k) {
        SCOPED_TRACE("saved at cycle " + std::to_string(leg * (k + 1)));
        Recorder record;
        Simulation resumed(scene, 0);
        resumed.load(states[k]);
        resumed.advance(leg, record);
        ASSERT_EQ(differences(states[k + 1], saved(resumed)), "");
        const auto first = straight_record.rows.begin() + static_cast<std::ptrdiff_t>(rows[k]);
        ASSERT_TRUE(std::ranges::equal(record.rows, std::span(first, rows[k + 1] - rows[k])));
    }
}

/// Keeps what is handed over as a checkpoint, the first of all included.
class Checkpoints : public Observer {
public:
    void on_checkpoint(const Simulation& simulation) override {
        archives.push_back(saved(simulation));
    }

    std::vector<Archive> archives;
};

TEST(Restart, ContinuesToTheSameBitsFromEveryCheckpoint) {
    Scene scene = thrown_bed();
    scene.stages.resize(1);  // a new stage would forget what a guard missed
    scene.output.checkpoint_interval = 0.003;
    scene.observables.energy.reset();
    Checkpoints checkpoints;
    Simulation straight(scene, 0);
    straight.advance(1U << 30, checkpoints);
    ASSERT_GT(checkpoints.archives.size(), 10U);
    EXPECT_EQ(checkpoints.archives.front().count("cycle"), 0U);
    for (const Archive& archive : checkpoints.archives) {
        Observer nobody;
        Simulation resumed(scene, 0);
        resumed.load(archive);
        resumed.advance(1U << 30, nobody);
        EXPECT_EQ(differences(saved(straight), saved(resumed)), "")
            << "saved at cycle " << archive.count("cycle");
    }
}

TEST(Restart, RefusesAStateThatDoesNotFitTheScene) {
    const Scene scene = thrown_bed();
    Observer nobody;
    Simulation straight(scene, 0);
    straight.advance(1500, nobody);
    const Archive good = saved(straight);
    for (const auto& [name, column] : good.columns()) {
        // Texts of warnings, of any length; the others have a length that the scene decides.
        if (name.ends_with("_warning")) {
            continue;
        }
        Archive bad = good;
        Archive::Column longer = column;
        std::visit([](auto& values) { values.resize(values.size() + 1); }, longer);
        bad.put_column(name, longer);
        Simulation resumed(scene, 0);
        EXPECT_THROW(resumed.load(bad), Error) << name;
    }
    for (const std::string name : {"pairs/objects/j", "wall-1/contacts/objects/j"}) {
        Archive bad = good;
        std::vector<std::uint32_t> beyond = good.get<std::uint32_t>(name);
        ASSERT_FALSE(beyond.empty());
        beyond.back() = 1U << 30;
        bad.put(name, beyond);
        Simulation resumed(scene, 0);
        EXPECT_THROW(resumed.load(bad), Error) << name;
    }
}

}  // namespace
}  // namespace grainbench::test
