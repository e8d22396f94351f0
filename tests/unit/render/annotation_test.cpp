/// What stands around the particles.
#include "render/annotation.hpp"

#include "io/vtk/session.hpp"

#include <gtest/gtest.h>

namespace grainbench::render {
namespace {

TEST(RoundLength, IsTheLargestOfOneTwoFiveThatFits) {
    EXPECT_EQ(round_length(0.034).second, "20 mm");
    EXPECT_EQ(round_length(0.0500001).second, "50 mm");
    EXPECT_EQ(round_length(0.9).second, "500 mm");
    EXPECT_EQ(round_length(7.0).second, "5 m");
    EXPECT_EQ(round_length(3e-5).second, "20 um");
    EXPECT_EQ(round_length(2500.0).second, "2 km");
}

TEST(TimeText, HasTheDecimalsThatTellFramesApart) {
    EXPECT_EQ(time_text(6.0000123, 0.2), "t = 6.0 s");
    EXPECT_EQ(time_text(6.0000123, 2.0), "t = 6 s");
    EXPECT_EQ(time_text(0.12, 0.02000199), "t = 0.12 s");
    EXPECT_EQ(time_text(0.25, 0.25), "t = 0.25 s");
    EXPECT_EQ(time_text(1e-4, 1e-4), "t = 0.0001 s");
}

TEST(AnnotationLayout, LeavesRoomForParticlesAtEverySize) {
    const io::VtkSession session;
    const Annotation all{
        .title = "A title of some length",
        .time = "t = 12.00 s",
        .key = ColourKey{"layer at start", {{"1", {}}, {"2", {}}, {"3", {}}, {"4", {}}, {"5", {}}}},
        .scales = {ColourScale{"speed [m/s]", ColourMap::viridis, {0.0, 0.5}}},
        .labels = {"realisation 1 (seed 1)", "realisation 2 (seed 2)"},
        .has_scale_bar = true};
    for (const ImageSize size : {ImageSize{1, 1},
                                 {60, 40},
                                 {320, 240},
                                 {1600, 1000},
                                 {8192, 8192},
                                 {3000, 200},
                                 {200, 3000}}) {
        const AnnotationLayout layout(all, size, false, 1);
        const Frame& frame = layout.frame();
        EXPECT_GE(frame.left, 0.0) << size.width;
        EXPECT_GE(frame.bottom, 0.0) << size.width;
        EXPECT_LE(frame.right, 1.0) << size.width;
        EXPECT_LE(frame.top, 1.0) << size.width;
        EXPECT_GT(frame.right - frame.left, 0.4) << size.width;
        EXPECT_GT(frame.top - frame.bottom, 0.4) << size.width;
    }
}

}  // namespace
}  // namespace grainbench::render
