/// Pictures of runs, as files: what makes them the same, and what must not break them.
#include "render/snapshot.hpp"

#include "core/error.hpp"

#include "io/atomic_file.hpp"

#include "render/look_json.hpp"

#include "tests/unit/io/temporary_folder.hpp"
#include "tests/unit/render/small_run.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>
#include <map>

namespace grainbench::render {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Key;
using testing::Pair;

Look small_look() {
    Look look = default_look(true);
    look.width = 160;
    look.height = 120;
    return look;
}

Snapshot drawn(const std::filesystem::path& run, const Look& look, std::size_t frame = 1) {
    return SnapshotPainter(run, look, "grainbench test").draw(frame);
}

std::size_t pixels_unlike_the_corner(const Image& image) {
    std::size_t count = 0;
    for (std::size_t k = 0; k < image.rgb.size(); k += 3) {
        count += std::equal(image.rgb.begin(),
                            image.rgb.begin() + 3,
                            image.rgb.begin() + static_cast<std::ptrdiff_t>(k))
                     ? 0U
                     : 1U;
    }
    return count;
}

TEST(Snapshot, SameFrameGivesTheSameBytesWhateverWasDrawnBefore) {
    const TemporaryFolder folder;
    write_small_run(folder.path());
    const auto bytes = [](const Snapshot& snapshot) {
        return encode_png(snapshot.image, snapshot.text);
    };
    const std::string alone = bytes(drawn(folder.path(), small_look()));
    SnapshotPainter painter(folder.path(), small_look(), "grainbench test");
    painter.draw(2);
    painter.draw(0);
    EXPECT_EQ(bytes(painter.draw(1)), alone);
    EXPECT_NE(bytes(painter.draw(2)), alone);
}

TEST(Snapshot, SaysWhereItComesFrom) {
    const TemporaryFolder folder;
    write_small_run(folder.path());
    const ImageText text = drawn(folder.path(), small_look()).text;
    EXPECT_THAT(text,
                AllOf(Contains(Pair("Software", "grainbench test")),
                      Contains(Pair("Scene hash", "0123456789abcdef")),
                      Contains(Pair("Seed", "8 9")),
                      Contains(Pair("Time [s]", "0.1")),
                      Contains(Pair("GL renderer", HasSubstr("OpenGL"))),
                      Contains(Key("Look"))));
}

TEST(Snapshot, RunWithoutOrWithOneParticleIsDrawn) {
    for (const std::size_t count : {0U, 1U}) {
        const TemporaryFolder folder;
        write_small_run(folder.path(), count);
        Look look = small_look();
        look.walls.reset();
        EXPECT_EQ(drawn(folder.path(), look).image.size, (ImageSize{160, 120}));
        look.particles->colour = SpeedColour{};
        EXPECT_EQ(drawn(folder.path(), look).image.size, (ImageSize{160, 120}));
    }
}

TEST(Snapshot, AnySizeIsDrawn) {
    const TemporaryFolder folder;
    write_small_run(folder.path());
    for (const AntiAliasing smoothing :
         {AntiAliasing::none, AntiAliasing::fxaa, AntiAliasing::supersampling}) {
        for (const ImageSize size : {ImageSize{1, 1}, {2, 300}, {300, 2}, {333, 111}}) {
            Look look = small_look();
            look.anti_aliasing = smoothing;
            look.width = size.width;
            look.height = size.height;
            EXPECT_EQ(drawn(folder.path(), look).image.size, size);
        }
    }
}

TEST(Snapshot, NothingButBackgroundAtTheBorder) {
    const TemporaryFolder folder;
    write_small_run(folder.path());
    for (const Projection projection : {Projection::perspective, Projection::parallel}) {
        Look look = small_look();
        look.camera.projection = projection;
        look.camera.direction = {0.5, 1.0, -0.8};
        const Image image = drawn(folder.path(), look, 2).image;
        const auto is_paper = [&](int x, int y) {
            const auto k = static_cast<std::size_t>(3 * (y * image.size.width + x));
            return image.rgb[k] == 255 && image.rgb[k + 1] == 255 && image.rgb[k + 2] == 255;
        };
        for (int x = 0; x < image.size.width; ++x) {
            EXPECT_TRUE(is_paper(x, 0) && is_paper(x, image.size.height - 1)) << x;
        }
        for (int y = 0; y < image.size.height; ++y) {
            EXPECT_TRUE(is_paper(0, y) && is_paper(image.size.width - 1, y)) << y;
        }
    }
}

TEST(Snapshot, DamagedFrameIsAnInputOutputErrorThatNamesIt) {
    const TemporaryFolder folder;
    write_small_run(folder.path());
    const auto file = folder / "realisation-2" / "particles_000001.vtu";
    io::write_file(file, io::read_file(file).substr(0, 900));
    try {
        drawn(folder.path(), small_look());
        FAIL() << "a damaged file was drawn";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::input_output);
        EXPECT_THAT(error.what(), HasSubstr("particles_000001.vtu"));
    }
}

TEST(Snapshot, TimeOutsideTheRunIsRefused) {
    const TemporaryFolder folder;
    write_small_run(folder.path());
    const SnapshotPainter painter(folder.path(), small_look(), "grainbench test");
    EXPECT_EQ(painter.nearest(0.12), 1U);
    EXPECT_EQ(painter.nearest(std::numeric_limits<double>::infinity()), 2U);
    EXPECT_THROW(painter.nearest(5.0), Error);
}

class RenderPreset : public testing::TestWithParam<std::string> {};

TEST_P(RenderPreset, DrawsARun) {
    const TemporaryFolder folder;
    write_small_run(folder.path());
    Look look = read_look(std::filesystem::path(GRAINBENCH_SOURCE_DIR) / "presets" / "render" /
                          (GetParam() + ".json"));
    look.width = 200;
    look.height = 125;
    EXPECT_GT(pixels_unlike_the_corner(drawn(folder.path(), look, 2).image), 500U);
}

std::vector<std::string> preset_names() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(
             std::filesystem::path(GRAINBENCH_SOURCE_DIR) / "presets" / "render")) {
        names.push_back(entry.path().stem().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
    std::string name = info.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Looks, RenderPreset, testing::ValuesIn(preset_names()), test_name);

}  // namespace
}  // namespace grainbench::render
