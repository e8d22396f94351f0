/// Paths of traced particles, smoothed by means.
#include "render/trace_view.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace grainbench::render {
namespace {

/// Two particles that rise by 1 mm/s and swing by 10 mm at 10 Hz, twenty samples a period.
io::TraceTable shaken_paths(int samples) {
    io::TraceTable table;
    for (const std::int64_t id : {3, 8}) {
        for (int k = 0; k <= samples; ++k) {
            const double time = 0.005 * k;
            table.time.push_back(time);
            table.points.push_back(
                {.id = id,
                 .position = {0.01 * std::sin(20.0 * std::numbers::pi * time), 0.0, 1e-3 * time},
                 .velocity = {0.2 * std::numbers::pi * std::cos(20.0 * std::numbers::pi * time),
                              0.0,
                              1e-3}});
        }
    }
    return table;
}

TEST(MeanPath, LeavesOnlyTheDrift) {
    const io::TraceTable path = mean_path(shaken_paths(60), 1.0, 0.1);
    ASSERT_EQ(path.points.size(), 32U);  // every 0.02 s from 0 to 0.3 s, of each particle
    EXPECT_EQ(path.points[16].id, 8);
    for (std::size_t k = 0; k < path.points.size(); ++k) {
        if (path.time[k] < 0.05 || path.time[k] > 0.251) {
            continue;  // less than a period
        }
        // The argument of the sine, up to 19, is wrong by 4e-15 at most, and what it gives with it.
        EXPECT_NEAR(path.points[k].position.x, 0.0, 1e-16);
        EXPECT_NEAR(path.points[k].velocity.x, 0.0, 1e-14);
        EXPECT_NEAR(path.points[k].velocity.z, 1e-3, 1e-17);
        // Of a period from after one sample to another one: half a sample later than its middle.
        EXPECT_NEAR(path.points[k].position.z, 1e-3 * (path.time[k] + 0.0025), 1e-17);
    }
}

TEST(MeanPath, EndsAtTheTimeOfTheFrame) {
    const io::TraceTable path = mean_path(shaken_paths(60), 0.15, 0.1);
    EXPECT_NEAR(path.time.back(), 0.15, 1e-12);
    // Mean of the times 0.105, 0.110, ... 0.150.
    EXPECT_NEAR(path.points.back().position.z, 1e-3 * 0.1275, 1e-17);
}

TEST(MeanPath, KeepsEveryPointWithoutAnInterval) {
    const io::TraceTable all = shaken_paths(4);
    EXPECT_EQ(mean_path(all, 1.0, 0.0).time, all.time);
}

TEST(MeanPath, OfNothingIsNothing) {
    EXPECT_THAT(mean_path({}, 1.0, 0.1).points, testing::IsEmpty());
}

TEST(TraceView, NamesDriftAndSpeedApart) {
    const std::vector<io::TraceTable> all{shaken_paths(60)};
    EXPECT_EQ(view_traces(all, {.colour = SpeedColour{}}, 1.0).scale.title, "speed of trace [m/s]");
    const TraceView drift = view_traces(all, {.colour = SpeedColour{}, .interval = 0.1}, 1.0);
    EXPECT_EQ(drift.scale.title, "drift [m/s]");
    EXPECT_EQ(drift.colours.at(0).size(), drift.paths.at(0).points.size());
}

}  // namespace
}  // namespace grainbench::render
