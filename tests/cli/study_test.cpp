#include "io/atomic_file.hpp"

#include "tests/cli/invoke.hpp"
#include "tests/cli/scenes.hpp"
#include "tests/unit/io/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace grainbench::cli {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;

/// A study of the cup: the same again by another name, other seeds, and a weaker gravity.
constexpr const char* cup_study = R"({
  "format": "grainbench-study/1",
  "title": "Falling into a <cup>",
  "scene": "cup.json",
  "set": ["/stages/0/duration=0.02", "/stages/1/duration=0", "/output/frame_interval=null",
          "/output/history_interval=0.001"],
  "variants": [
    {"name": "as it is", "published": {"seconds": 10, "cycles": 1000}},
    {"name": "again", "set": ["/description=\"the same\""], "published": {"seconds": 5}},
    {"name": "on the moon", "set": ["/gravity/2=-1.6"]}
  ],
  "reference": "as it is",
  "observable": {"type": "history_curve", "column": "kinetic_energy", "points": 5},
  "margin": 1e-6,
  "realisations": 3,
  "comparison": "paired",
  "timing": {"duration": 0.005, "repetitions": 2},
  "growth": [2, 3]
})";

class StudyCommand : public testing::Test {
protected:
    StudyCommand() {
        io::write_file(folder_ / "cup.json", cup_scene);
        io::write_file(folder_ / "study.json", cup_study);
    }

    Answer study(std::vector<std::string> more = {}) const {
        std::vector<std::string> arguments{
            "study", (folder_ / "study.json").string(), "-o", (folder_ / "out").string()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return invoke(arguments);
    }

    TemporaryFolder folder_;
};

TEST_F(StudyCommand, TellsTheSameFromTheDifferent) {
    const Answer answer = study({"--json", "--quiet"});
    ASSERT_EQ(answer.code, 0) << answer.err;
    const json result = json::parse(answer.out);
    const json& variants = result.at("variants");
    ASSERT_EQ(variants.size(), 3U);
    EXPECT_EQ(variants[0].at("verdict"), "reference");
    // The same scene under another description starts from the same packings: the same bits.
    EXPECT_EQ(variants[1].at("verdict"), "same");
    EXPECT_EQ(variants[1].at("deviation").at("value"), 0.0);
    EXPECT_EQ(variants[2].at("verdict"), "different");
    // All of them fall freely at first, with g 1.6 instead of 9.8.
    EXPECT_LT(variants[2].at("deviation").at("value"), 0.0);
    EXPECT_EQ(variants[2].at("growth").size(), 2U);
    EXPECT_DOUBLE_EQ(variants[1].at("cost").at("published_speed_up"), 2.0);
    EXPECT_TRUE(variants[1].at("cost").at("timed_alone"));
    EXPECT_GT(variants[1].at("cost").at("cpu_seconds"), 0.0);
    EXPECT_EQ(variants[0].at("realisations"), 3);
}

TEST_F(StudyCommand, WritesAFolderToLookAt) {
    const Answer answer = study();
    ASSERT_EQ(answer.code, 0) << answer.err;
    EXPECT_THAT(answer.out,
                AllOf(ContainsRegex("again +3 .* same"),
                      ContainsRegex("on the moon +3 .* different"),
                      ContainsRegex("\n(Use|Stay with) '")));
    for (const char* name : {"index.html",
                             "study.md",
                             "study.json",
                             "variants.csv",
                             "curves.csv",
                             "overlay.svg",
                             "overlay.png",
                             "overlay.csv",
                             "cost.svg",
                             "cost.png",
                             "growth.svg"}) {
        EXPECT_TRUE(io::file_exists(folder_ / "out" / name)) << name;
    }
    EXPECT_THAT(io::read_file(folder_ / "out" / "index.html"),
                AllOf(HasSubstr("Falling into a &lt;cup&gt;"), HasSubstr("published speed-up")));
    EXPECT_THAT(io::read_file(folder_ / "out" / "study.md"),
                AllOf(HasSubstr("| on the moon |"), HasSubstr("How confidence grows")));
}

TEST_F(StudyCommand, UsesItsRunsAgain) {
    ASSERT_EQ(study().code, 0);
    const std::string before = io::read_file(folder_ / "out" / "variants.csv");
    const Answer again = study();
    EXPECT_THAT(again.err,
                AllOf(HasSubstr("3 runs: 0 to do, 3 in the cache"),
                      HasSubstr("6 timed runs, one at a time: 0 to do, 6 in the cache")));
    EXPECT_EQ(io::read_file(folder_ / "out" / "variants.csv"), before);
}

TEST_F(StudyCommand, SaysWhichVariantIsWrong) {
    json study_json = json::parse(cup_study);
    study_json["variants"][2]["set"] = {"/contact/friction/coeficient=0.1"};
    io::write_file(folder_ / "study.json", study_json.dump());
    const Answer answer = study();
    EXPECT_EQ(answer.code, 2);
    EXPECT_THAT(answer.err,
                AllOf(HasSubstr("variant 'on the moon'"),
                      HasSubstr("'coeficient'"),
                      HasSubstr("'coefficient'")));
}

TEST_F(StudyCommand, UnstableVariantIsSaidToBe) {
    json study_json = json::parse(cup_study);
    study_json["variants"][2]["set"] = {"/timestep={\"type\":\"fixed\",\"value\":1e-4}",
                                        "/contact/stiffness/normal=1e307",
                                        "/contact/normal/law=\"linear_spring\"",
                                        "/stages/0/duration=0.5"};
    study_json.erase("timing");
    study_json.erase("growth");
    io::write_file(folder_ / "study.json", study_json.dump());
    const Answer answer = study({"--json"});
    ASSERT_EQ(answer.code, 0) << answer.err;
    const json result = json::parse(answer.out);
    EXPECT_EQ(result.at("variants")[2].at("verdict"), "unstable") << answer.out;
    EXPECT_EQ(result.at("variants")[1].at("verdict"), "same");
}

TEST_F(StudyCommand, ObservesNumbersAndProfilesToo) {
    for (const char* observable :
         {R"({"type": "history_number", "column": "kinetic_energy", "reduction": "largest"})",
          R"({"type": "final_profile", "axis": "radius", "low": 0, "high": 0.04, "bins": 4})"}) {
        json study_json = json::parse(cup_study);
        study_json["observable"] = json::parse(observable);
        io::write_file(folder_ / "study.json", study_json.dump());
        const Answer answer = study({"--json", "--quiet"});
        ASSERT_EQ(answer.code, 0) << answer.err;
        const json result = json::parse(answer.out);
        EXPECT_EQ(result.at("variants")[1].at("verdict"), "same") << observable;
        EXPECT_EQ(result.at("variants")[0].at("mean").size(), result.at("x").size());
        EXPECT_TRUE(io::file_exists(folder_ / "out" / "overlay.png"));
    }
}

TEST_F(StudyCommand, ElevationIsAskedOfScenesThatMeasureIt) {
    json study_json = json::parse(cup_study);
    study_json["observable"] = {{"type", "elevation_curve"}};
    io::write_file(folder_ / "study.json", study_json.dump());
    const Answer answer = study();
    EXPECT_EQ(answer.code, 2);
    EXPECT_THAT(answer.err, HasSubstr("does not measure the elevation"));
}

TEST_F(StudyCommand, SuggestsAStudyForASceneAlone) {
    io::write_file(folder_ / "short.json",
                   R"({"extends": "cup.json", "stages": [{"name": "fall", "duration": 0.02}]})");
    const Answer answer = invoke({"study",
                                  "--suggest",
                                  (folder_ / "short.json").string(),
                                  "-o",
                                  (folder_ / "out").string(),
                                  "--json",
                                  "--quiet"});
    ASSERT_EQ(answer.code, 0) << answer.err;
    const json result = json::parse(answer.out);
    EXPECT_EQ(result.at("variants").size(), 8U);
    EXPECT_THAT(result.at("recommendation").get<std::string>(),
                ContainsRegex("^(Use|Stay with) '"));
    // What was suggested may be kept, changed and run.
    io::write_file(folder_ / "kept.json", io::read_file(folder_ / "out" / "suggested-study.json"));
    const Answer kept = invoke({"study",
                                (folder_ / "kept.json").string(),
                                "-o",
                                (folder_ / "kept").string(),
                                "--cache",
                                (folder_ / "out" / "runs").string()});
    EXPECT_EQ(kept.code, 0) << kept.err;
    EXPECT_THAT(kept.err, HasSubstr("0 to do"));
}

TEST_F(StudyCommand, WantsOneFile) {
    EXPECT_EQ(invoke({"study"}).code, 2);
    EXPECT_EQ(study({"--suggest", (folder_ / "cup.json").string()}).code, 2);
}

TEST(SingleContact, WritesTablesAndCharts) {
    const TemporaryFolder folder;
    const Answer answer = invoke({"study", "--single-contact", "-o", (folder / "out").string()});
    ASSERT_EQ(answer.code, 0) << answer.err;
    EXPECT_THAT(answer.out,
                AllOf(HasSubstr("order of convergence"),
                      ContainsRegex("incremental_spring, mode 3 "),
                      ContainsRegex("energy after an impact: .* at 2e-5 s")));
    for (const char* name : {"index.html", "single-contact.md", "single-contact.csv", "step.svg"}) {
        EXPECT_TRUE(io::file_exists(folder / "out" / name)) << name;
    }
}

TEST(StabilityMap, WritesBothCharts) {
    const TemporaryFolder folder;
    const Answer answer =
        invoke({"study", "--stability-map", "--quick", "-o", (folder / "out").string()});
    ASSERT_EQ(answer.code, 0) << answer.err;
    // All of them, for none of the 42 lies next to the limit.
    EXPECT_THAT(answer.out,
                AllOf(HasSubstr("42 of 42 points"),
                      ContainsRegex("\n +1e-05 s +[0-9.]+ %\n +2e-05 s +[0-9.]+ %\n$")));
    for (const std::string name : {"stability-map", "shaken-bed"}) {
        for (const std::string extension : {".svg", ".png", ".csv"}) {
            EXPECT_TRUE(io::file_exists(folder / "out" / (name + extension))) << name << extension;
        }
    }
}

TEST(StudyCommandLine, RefusesWhatWouldDoNothing) {
    for (const char* map : {"--single-contact", "--stability-map"}) {
        EXPECT_EQ(invoke({"study", map, "--json"}).code, 2);
        EXPECT_EQ(invoke({"study", map, "--threads", "2"}).code, 2);
        EXPECT_EQ(invoke({"study", map, "--cache", "somewhere"}).code, 2);
    }
    EXPECT_EQ(invoke({"study", "--single-contact", "--quick"}).code, 2);
}

/// Every file of presets/studies by its name without ".json".
std::vector<std::string> study_names() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(
             std::string(GRAINBENCH_SOURCE_DIR) + "/presets/studies")) {
        names.push_back(entry.path().stem().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

class StudyPreset : public testing::TestWithParam<std::string> {};

TEST_P(StudyPreset, RunsQuickly) {
    const TemporaryFolder folder;
    const Answer answer =
        invoke({"study",
                std::string(GRAINBENCH_SOURCE_DIR) + "/presets/studies/" + GetParam() + ".json",
                "--quick",
                "--json",
                "--quiet",
                "-o",
                (folder / "out").string()});
    ASSERT_EQ(answer.code, 0) << answer.err;
    const json result = json::parse(answer.out);
    EXPECT_TRUE(result.at("quick"));
    EXPECT_GE(result.at("variants").size(), 2U);
    for (const json& variant : result.at("variants")) {
        EXPECT_NE(variant.at("verdict"), "unstable") << variant;
        EXPECT_GT(variant.at("cost").at("cycles"), 0.0);
    }
    EXPECT_TRUE(io::file_exists(folder / "out" / "index.html"));
}

std::string name_of_study(const testing::TestParamInfo<std::string>& info) {
    std::string name = info.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(All, StudyPreset, testing::ValuesIn(study_names()), name_of_study);

}  // namespace
}  // namespace grainbench::cli
