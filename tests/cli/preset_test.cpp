#include "io/atomic_file.hpp"
#include "io/hdf5/checkpoint.hpp"
#include "io/hdf5/history.hpp"
#include "io/json/scene_json.hpp"
#include "io/run_folder.hpp"
#include "io/vtk/frame_reader.hpp"
#include "io/vtk/pvd.hpp"

#include "tests/cli/invoke.hpp"
#include "tests/unit/io/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace grainbench::cli {
namespace {

using testing::SizeIs;

/// Every file of presets/scenes by its name without ".json".
std::vector<std::string> preset_names() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(preset(""))) {
        names.push_back(entry.path().stem().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

/// Some tens of steps of the scheme; an automatic step in the presets is about 1e-5 s.
double short_duration(const Timestep& scheme) {
    return std::visit(Overloaded{[](const AutomaticTimestep&) { return 3e-4; },
                                 [](const auto& chosen) { return 20.0 * chosen.value; }},
                      scheme);
}

class Preset : public testing::TestWithParam<std::string> {};

TEST_P(Preset, RunsShortenedIntoAFolderThatReadsBack) {
    const TemporaryFolder folder;
    const std::string file = preset(GetParam() + ".json");
    const Scene scene = io::read_scene(file);
    std::vector<std::string> arguments{
        "run", file, "-o", (folder / "run").string(), "--set", "/realisations/count=1"};
    for (std::size_t s = 0; s < scene.stages.size(); ++s) {
        const double duration = short_duration(scene.stages[s].timestep.value_or(scene.timestep));
        arguments.push_back("--set");
        arguments.push_back("/stages/" + std::to_string(s) +
                            "/duration=" + std::to_string(duration));
    }
    const Answer answer = invoke(arguments);
    ASSERT_EQ(answer.code, 0) << answer.err;

    const auto run = folder / "run";
    const auto manifest = nlohmann::json::parse(io::read_file(run / "manifest.json"));
    EXPECT_EQ(manifest.at("outcome"), "finished");
    const auto& realisation = manifest.at("realisations").at(0);
    EXPECT_GE(realisation.at("cycles"), 10);
    EXPECT_LE(realisation.at("cycles"), 200);
    const auto particles = realisation.at("particles").get<std::size_t>();
    EXPECT_GT(particles, 0U);

    const Scene effective = io::read_scene(run / "scene.json");
    EXPECT_EQ(effective.stages.size(), scene.stages.size());
    const io::History history = io::read_history(run / "history.h5");
    EXPECT_GE(history.realisations.at(0).history.rows(), 2U);
    std::string warning;
    const auto checkpoint = io::read_checkpoint(run / "checkpoint.h5", history.scene_hash, warning);
    ASSERT_TRUE(checkpoint.has_value());
    EXPECT_TRUE(checkpoint->realisations.at(0).has_value());
    EXPECT_EQ(warning, "");
    const auto place = run / "realisation-1";
    for (const io::PvdEntry& entry : io::read_pvd(place / "particles.pvd")) {
        EXPECT_EQ(io::read_particles_frame(place / entry.file).size(), particles);
    }
    for (const io::PvdEntry& entry : io::read_pvd(place / "walls.pvd")) {
        EXPECT_THAT(io::read_walls_frame(place / entry.file).walls, SizeIs(scene.walls.size()));
    }
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
    std::string name = info.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

TEST(Readme, SceneIsOneThatRuns) {
    const std::string page = io::read_file(std::string(GRAINBENCH_SOURCE_DIR) + "/README.md");
    const std::string fence = "```json\n";
    const std::size_t start = page.find(fence);
    ASSERT_NE(start, std::string::npos);
    const std::size_t end = page.find("```", start + fence.size());
    const TemporaryFolder folder;
    io::write_file(folder / "readme.json",
                   page.substr(start + fence.size(), end - start - fence.size()));
    const Answer answer = invoke({"run",
                                  (folder / "readme.json").string(),
                                  "-o",
                                  (folder / "run").string(),
                                  "--set",
                                  "/stages/0/duration=1e-3"});
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_TRUE(io::file_exists(folder / "run" / "realisation-1" / "particles.pvd"));
}

INSTANTIATE_TEST_SUITE_P(Scenes, Preset, testing::ValuesIn(preset_names()), test_name);

}  // namespace
}  // namespace grainbench::cli
