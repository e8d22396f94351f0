/// Pictures of a run made by hand against baselines, by the code of `grainbench compare`.
#include "io/atomic_file.hpp"

#include "render/image_comparison.hpp"
#include "render/look_json.hpp"
#include "render/snapshot.hpp"

#include "tests/unit/io/temporary_folder.hpp"
#include "tests/unit/render/small_run.hpp"

#include <gtest/gtest.h>

#include <ostream>

namespace grainbench::render {
namespace {

/// Largest 1 - SSIM. Vectors of 128 and 256 bits in OSMesa give the same pixels; another version of
/// it may round colours and edges otherwise, by some thousandths. A layout that moved by a few
/// pixels gave 0.45.
constexpr double threshold = 0.02;

struct Case {
    std::string name;
    std::vector<std::string> changes;  ///< of the default look
};

std::ostream& operator<<(std::ostream& stream, const Case& of) {
    return stream << of.name;
}

class Baseline : public testing::TestWithParam<Case> {};

TEST_P(Baseline, LooksAsItDid) {
    const TemporaryFolder folder;
    write_small_run(folder.path());
    std::vector<std::string> changes{"/width=320", "/height=240"};
    changes.insert(changes.end(), GetParam().changes.begin(), GetParam().changes.end());
    SnapshotPainter painter(folder.path(), default_look(true, changes), "grainbench test");
    const Snapshot now = painter.draw(2);

    const std::filesystem::path pictures = GRAINBENCH_PICTURE_DIR;
    const auto picture = pictures / (GetParam().name + ".png");
    const auto difference = pictures / (GetParam().name + "-difference.png");
    const auto baseline = std::filesystem::path(GRAINBENCH_SOURCE_DIR) / "tests" / "image" /
                          "baselines" / (GetParam().name + ".png");
    io::make_folder(pictures);
    write_png(picture, now.image, now.text);
    const ImageComparison comparison = compare_images(read_png(baseline), now.image);
    if (1.0 - comparison.similarity > threshold) {
        write_png(difference, comparison.difference, {});
        FAIL() << "SSIM " << comparison.similarity << ": " << similarity_in_words(comparison)
               << ", least alike around (" << comparison.lowest_x << ", " << comparison.lowest_y
               << ")\n  baseline   " << baseline << "\n  now        " << picture
               << "\n  difference " << difference
               << "\n  next step: look at them; if the new picture is right, copy it over the "
                  "baseline";
    }
}

std::string test_name(const testing::TestParamInfo<Case>& info) {
    return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(
    Pictures,
    Baseline,
    testing::Values(
        Case{"layers",
             {R"(/camera/direction=[0.4, 1, -0.5])", "/title=Layers", "/realisation_labels={}"}},
        Case{"top_layer_dark",
             {"/background=dark",
              "/camera/projection=parallel",
              R"(/particles/colour={"type": "species"})",
              R"(/particles/filters=[{"type": "layers", "layers": [1], "and_species": ["large"]}])",
              "/anti_aliasing=supersampling"}},
        Case{"slice_force",
             {R"(/particles/colour={"type": "array", "array": "force", "map": "batlow"})",
              R"(/particles/filters=[{"type": "slice", "axis": "y", "low": 0, "high": 1}])",
              "/ambient_occlusion=null",
              R"(/realisations=[2])"}},
        Case{"traces",
             {"/particles=null",
              R"(/traces={"colour": {"type": "time"}, "radius": 0.001, "interval": 0.01})",
              R"(/walls/region={"low": [-1, -1, -1], "high": [1, 1, 0.04]})",
              "/ambient_occlusion=null"}}),
    test_name);

}  // namespace
}  // namespace grainbench::render
