// Names in presets are text in files and never places: nothing is written but below what -o names.
#include "io/atomic_file.hpp"
#include "io/vtk/pvd.hpp"

#include "tests/cli/invoke.hpp"
#include "tests/cli/scenes.hpp"
#include "tests/unit/io/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace grainbench::cli {
namespace {

using nlohmann::json;
using testing::UnorderedElementsAre;

class Paths : public testing::Test {
protected:
    /// The cup with names that would lead out of any folder they were put behind.
    json hostile_scene() const {
        json scene = json::parse(cup_scene);
        const std::string species = "../../escaped-species";
        const std::string wall = (folder_ / "escaped-wall").string();
        scene["title"] = "../escaped-title";
        scene["particles"]["species"][0]["name"] = species;
        scene["particles"]["insertion"][0]["species"] = species;
        scene["walls"][0]["name"] = wall;
        scene["stages"][0]["name"] = "../../escaped-stage";
        scene["stages"][1]["motions"][0]["wall"] = wall;
        scene["stages"][0]["duration"] = 0.01;
        scene["stages"][1]["duration"] = 0.01;
        scene["output"] = {{"frame_interval", 0.01}, {"contacts", true}};
        return scene;
    }

    std::string write(const std::string& name, const json& document) const {
        io::write_file(folder_ / "in" / name, document.dump());
        return (folder_ / "in" / name).string();
    }

    std::string out(const std::string& name) const { return (folder_ / "out" / name).string(); }

    void expect_success(std::vector<std::string> arguments) const {
        const Answer answer = invoke(std::move(arguments));
        EXPECT_EQ(answer.code, 0) << answer.err;
    }

    static std::vector<std::string> entries_of(const std::filesystem::path& folder) {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder)) {
            names.push_back(entry.path().filename().string());
        }
        return names;
    }

    TemporaryFolder folder_;
};

TEST_F(Paths, OfOutputStayBelowWhatTheUserNamed) {
    std::filesystem::create_directories(folder_ / "in");
    std::filesystem::create_directories(folder_ / "out");
    const std::string scene = write("scene.json", hostile_scene());
    const std::string study = write(
        "study.json",
        {{"format", "grainbench-study/1"},
         {"title", "../escaped-study"},
         {"scene", "scene.json"},
         {"set", {"/output/history_interval=0.005"}},
         {"variants",
          {{{"name", "../../escaped-variant"}},
           {{"name", (folder_ / "escaped-variant").string()}, {"set", {"/gravity/2=-5"}}}}},
         {"reference", "../../escaped-variant"},
         {"observable", {{"type", "history_curve"}, {"column", "kinetic_energy"}, {"points", 2}}},
         {"margin", 0.1},
         {"realisations", 2}});
    expect_success({"run", scene, "-o", out("run"), "--quiet"});
    expect_success({"study", study, "-o", out("study"), "--quiet"});
    expect_success({"render", out("run"), "-o", out("pictures"), "--size", "60x40"});
    // A list of frames that somebody changed: what stands before the name of a file is dropped.
    const std::filesystem::path list = folder_ / "out/run/realisation-1/particles.pvd";
    std::vector<io::PvdEntry> frames = io::read_pvd(list);
    ASSERT_FALSE(frames.empty());
    frames[0].file = "../../../escaped/" + frames[0].file;
    io::write_pvd(list, frames);
    for (const std::string format : {"vtu", "vtp", "csv"}) {
        expect_success({"export", out("run"), "--format", format, "-o", out(format)});
    }

    EXPECT_THAT(entries_of(folder_.path()), UnorderedElementsAre("in", "out"));
    EXPECT_THAT(entries_of(folder_ / "in"), UnorderedElementsAre("scene.json", "study.json"));
    EXPECT_THAT(entries_of(folder_ / "out"),
                UnorderedElementsAre("run", "study", "pictures", "vtu", "vtp", "csv"));
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_.path())) {
        EXPECT_EQ(entry.path().filename().string().find("escaped"), std::string::npos)
            << entry.path();
    }
}

}  // namespace
}  // namespace grainbench::cli
