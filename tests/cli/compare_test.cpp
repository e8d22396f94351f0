// Bench results and run folders by command; pictures are compared in render_test.cpp.
#include "tests/cli/invoke.hpp"
#include "tests/cli/scenes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace grainbench::cli {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// A result with two benchmarks, whose least times are given in ns and whose medians lie 1 % above.
std::string bench_file(const std::string& name, double bed, double shaken) {
    Json json{{"format", "grainbench-bench/2"},
              {"cpu_model", "some processor"},
              {"isa", "avx2"},
              {"compiler", "some compiler"},
              {"threads", 1},
              {"benchmarks", Json::array()}};
    for (const auto& [benchmark, time] : {std::pair{"bed", bed}, std::pair{"shaken", shaken}}) {
        json["benchmarks"].push_back({{"name", benchmark},
                                      {"step_time", 1e-9 * time},
                                      {"step_time_median", 1.01e-9 * time}});
    }
    const std::string file = ::testing::TempDir() + name;
    std::ofstream(file) << json.dump();
    return file;
}

/// The noise of a ratio is 1.41 %: 1 % is within it, 5 % is slower, 11 % over the usual threshold.
TEST(CompareBench, JudgesByNoiseAndThreshold) {
    const std::string before = bench_file("before.json", 100.0, 10.0);
    EXPECT_EQ(invoke({"compare", before, bench_file("noise.json", 101.0, 9.9)}).code, 0);
    const Answer slower = invoke({"compare", before, bench_file("slower.json", 105.0, 9.0)});
    EXPECT_EQ(slower.code, 0);
    EXPECT_THAT(slower.out, HasSubstr("slower"));
    EXPECT_THAT(slower.out, HasSubstr("faster"));
    const std::string slow = bench_file("slow.json", 111.0, 10.0);
    const Answer too_slow = invoke({"compare", before, slow, "--json"});
    EXPECT_EQ(too_slow.code, 4);
    const Json json = Json::parse(too_slow.out);
    EXPECT_EQ(json.at("benchmarks").at(0).at("verdict"), "too slow");
    EXPECT_EQ(json.at("benchmarks").at(1).at("verdict"), "same");
    EXPECT_NEAR(json.at("benchmarks").at(0).at("ratio"), 1.11, 1e-9);
    EXPECT_NEAR(json.at("benchmarks").at(0).at("noise"), 0.0141421, 1e-6);
    EXPECT_EQ(invoke({"compare", before, slow, "--threshold", "0.2"}).code, 0);
}

TEST(CompareBench, RefusesOtherFiles) {
    const std::string file = ::testing::TempDir() + "other.json";
    std::ofstream(file) << R"({"format": "grainbench-scene/1"})";
    const Answer answer = invoke({"compare", file, file});
    EXPECT_EQ(answer.code, 2);
    EXPECT_THAT(answer.err, HasSubstr("grainbench-scene/1"));
    EXPECT_EQ(invoke({"compare", file, ::testing::TempDir()}).code, 2);
    EXPECT_EQ(invoke({"compare", "missing.json", file}).code, 5);
}

class CompareRuns : public ::testing::Test {
protected:
    /// A folder for each test: they may run side by side.
    void SetUp() override {
        folder_ = fs::path(::testing::TempDir()) /
                  ::testing::UnitTest::GetInstance()->current_test_info()->name();
        fs::remove_all(folder_);
        fs::create_directories(folder_);
        std::ofstream(folder_ / "cup.json") << cup_scene;
    }

    std::string run(const std::string& name, const std::string& setting) const {
        const std::string folder = (folder_ / name).string();
        std::vector<std::string> arguments{
            "run", (folder_ / "cup.json").string(), "-o", folder, "--quiet", "--set", setting};
        EXPECT_EQ(invoke(arguments).code, 0);
        return folder;
    }

    fs::path folder_;
};

TEST_F(CompareRuns, FindsEqualRunsEqual) {
    const std::string title = "/title=\"two\"";
    const Answer answer = invoke({"compare", run("a", title), run("b", title)});
    EXPECT_EQ(answer.code, 0) << answer.out;
    EXPECT_THAT(answer.out, HasSubstr("10 of 10 files hold the same bits"));
    EXPECT_THAT(answer.out, HasSubstr("the two runs are the same"));
}

/// Friction acts from the first contact on; the start is the same.
TEST_F(CompareRuns, TellWhereAndHowFarRunsPart) {
    const std::string rough = run("rough", "/contact/friction/coefficient=0.6");
    const std::string smooth = run("smooth", "/contact/friction/coefficient=0.59");
    const Answer answer = invoke({"compare", rough, smooth, "--json"});
    EXPECT_EQ(answer.code, 4);
    const Json json = Json::parse(answer.out);
    EXPECT_FALSE(json.at("same"));
    EXPECT_FALSE(json.at("same_last_state"));
    EXPECT_GT(json.at("first_differing_row").at("row"), 0);
    EXPECT_GT(json.at("first_differing_row").at("cycle"), 0);
    EXPECT_GT(json.at("differing_particle_files"), 0);
    EXPECT_LT(json.at("differing_particle_files"), json.at("particle_files"));
    double largest = 0.0;
    for (const Json& deviation : json.at("deviations")) {
        largest = std::max(largest, deviation.at("relative").get<double>());
    }
    EXPECT_GT(largest, 0.0);
    EXPECT_EQ(
        invoke({"compare", rough, smooth, "--threshold", std::to_string(1.01 * largest)}).code, 0);
    EXPECT_EQ(invoke({"compare", rough, smooth, "-o", "x.png"}).code, 2);
}

}  // namespace
}  // namespace grainbench::cli
