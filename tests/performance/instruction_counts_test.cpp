/// Instructions per particle-step of the scalar passes: a slowdown is seen without a clock. The
/// committed counts are those of one compiler; other compilers are not compared.
#include "tests/performance/callgrind_profile.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>
#include <fstream>

namespace grainbench::test {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// Counts repeat to about 1e-4: what is left are addresses, on which memory routines depend. Three
/// percent is what a person can judge; more in either direction asks for a new baseline.
constexpr double band = 0.03;

/// Functions with less than this part of a case are summed up.
constexpr double smallest_part = 0.005;

struct Counts {
    double total = 0.0;  ///< instructions per particle-step
    std::map<std::string, double> functions;
};

/// Runs all cases in one process under callgrind.
std::map<std::string, Counts> count_instructions() {
    const fs::path folder = fs::path(::testing::TempDir()) / "grainbench-instruction-counts";
    fs::remove_all(folder);
    fs::create_directories(folder);
    const std::string command = fmt::format(
        "'{}' --tool=callgrind --instr-atstart=no --callgrind-out-file='{}' '{}' > '{}' 2> '{}'",
        GRAINBENCH_VALGRIND,
        (folder / "counts").string(),
        GRAINBENCH_COUNTED_STEPS,
        (folder / "steps").string(),
        (folder / "log").string());
    if (std::system(command.c_str()) != 0) {
        std::stringstream log;
        log << std::ifstream(folder / "log").rdbuf();
        throw std::runtime_error("callgrind failed: " + command + "\n" + log.str());
    }
    std::map<std::string, double> steps;
    std::ifstream in(folder / "steps");
    double count = 0.0;
    for (std::string name; in >> name >> count;) {
        steps[name] = count;
    }
    std::map<std::string, Counts> result;
    for (const auto& file : fs::directory_iterator(folder)) {
        if (!file.path().filename().string().starts_with("counts.")) {
            continue;
        }
        const CallgrindProfile profile = read_callgrind(file.path());
        const auto found = steps.find(profile.trigger);
        if (found == steps.end()) {
            continue;  // written when the program ended
        }
        Counts& counts = result[profile.trigger];
        counts.total = profile.total() / found->second;
        for (const auto& [name, instructions] : profile.instructions) {
            const double own = instructions / found->second;
            counts.functions[own < smallest_part * counts.total ? "others" : name] += own;
        }
    }
    fs::remove_all(folder);
    return result;
}

double rounded(double x) {
    return std::round(10.0 * x) / 10.0;
}

void write_baseline(const std::map<std::string, Counts>& counts) {
    Json json{{"build", GRAINBENCH_BUILD}, {"cases", Json::object()}};
    for (const auto& [name, count] : counts) {
        Json functions;
        for (const auto& [function, own] : count.functions) {
            functions[function] = rounded(own);
        }
        json["cases"][name] = {{"total", rounded(count.total)}, {"functions", functions}};
    }
    std::ofstream(GRAINBENCH_BASELINE) << json.dump(2) << "\n";
}

TEST(InstructionCounts, StayWithinThreePercentOfTheBaseline) {
    const Json baseline = Json::parse(std::ifstream(GRAINBENCH_BASELINE), nullptr, false);
    const bool renews = std::getenv("GRAINBENCH_RENEW_COUNTS") != nullptr;
    if (!renews && baseline.at("build") != GRAINBENCH_BUILD) {
        GTEST_SKIP() << "this build is '" << GRAINBENCH_BUILD << "', the counts were taken with '"
                     << baseline.at("build").get<std::string>() << "'";
    }
    const std::map<std::string, Counts> now = count_instructions();
    if (renews) {
        write_baseline(now);
        return;
    }
    const Json& cases = baseline.at("cases");
    EXPECT_EQ(now.size(), cases.size()) << "a case was added or taken away: renew the baseline";
    for (const auto& [name, counts] : now) {
        if (!cases.contains(name)) {
            continue;
        }
        const double before = cases.at(name).at("total");
        const double growth = counts.total / before - 1.0;
        RecordProperty(name, fmt::format("{:.1f}", counts.total));
        if (std::abs(growth) > band) {
            ADD_FAILURE()
                << fmt::format(
                       "{}: {:.1f} instructions per particle-step, were {:.1f} ({:+.1f} %, band "
                       "{:.0f} %)\n"
                       "what changed most, without what each calls:\n{}",
                       name,
                       counts.total,
                       before,
                       100.0 * growth,
                       100.0 * band,
                       describe_changes(
                           cases.at(name).at("functions").get<std::map<std::string, double>>(),
                           counts.functions))
                << "if this is meant: cmake --build --preset release --target "
                   "renew_instruction_counts, and say why in the commit";
        }
    }
    // A scene pays only for the effects that it calls for.
    ASSERT_TRUE(now.contains("rest_all") && now.contains("rest_linear_spring"));
    EXPECT_LT(now.at("rest_linear_spring").total, 0.6 * now.at("rest_all").total);
}

}  // namespace
}  // namespace grainbench::test
