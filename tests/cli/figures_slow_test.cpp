/// The whole set of the example, shortened: every figure of the preset can be made.
#include "io/atomic_file.hpp"

#include "render/image.hpp"

#include "cli/figures/figure_set.hpp"

#include "tests/cli/invoke.hpp"
#include "tests/unit/io/temporary_folder.hpp"

#include <gtest/gtest.h>

namespace grainbench::cli {
namespace {

TEST(FigurePreset, DrawsEveryFigureOfTheExampleQuickly) {
    const TemporaryFolder folder;
    const std::string file = std::string(GRAINBENCH_SOURCE_DIR) + "/presets/figures/bne.json";
    const Answer answer = invoke({"figures", file, "--quick", "-o", folder.path().string()});
    ASSERT_EQ(answer.code, 0) << answer.err;
    const std::string page = io::read_file(folder / "index.md");
    for (const Figure& figure : read_figure_set(file).figures) {
        EXPECT_NE(page.find("\n## " + name_of(figure) + "\n"), std::string::npos)
            << name_of(figure);
    }
    std::size_t pictures = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "figures")) {
        if (entry.path().extension() == ".png") {
            EXPECT_GE(render::read_png(entry.path()).size.width, 1000) << entry.path();
            ++pictures;
        }
    }
    EXPECT_GT(pictures, read_figure_set(file).figures.size());
}

}  // namespace
}  // namespace grainbench::cli
