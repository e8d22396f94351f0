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
    }
}

TEST(Restart, ContinuesToTheSameBits) {
    expect_same_after_restart(thrown_bed(), {{1401, 0}, {1899, 0}, {2300, 1}, {2450, 1}});
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

}  // namespace
}  // namespace grainbench::test
