#include "cli/compare/bench_comparison.hpp"

#include "core/error.hpp"

#include "io/json/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

namespace grainbench::cli {
namespace {

using io::Json;

constexpr std::array<const char*, 4> verdict_names = {"same", "faster", "slower", "too slow"};

struct Timed {
    std::string name;
    double least = 0.0;   ///< [s]
    double median = 0.0;  ///< [s]

    double noise() const { return (median - least) / least; }
};

struct Results {
    std::string cpu, isa, compiler;
    unsigned threads = 1;
    std::vector<Timed> benchmarks;
};

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& cause) {
    throw_bad_input({.what = "this is no result of `grainbench bench`",
                     .where = path.string(),
                     .likely_cause = cause,
                     .next_step = "grainbench bench -o " + path.filename().string()});
}

Results read_results(const std::filesystem::path& path) {
    std::ifstream file(path);
    if (!file) {
        throw_input_output({.what = "the file cannot be read",
                            .where = path.string(),
                            .likely_cause = "it is missing or not readable",
                            .next_step = "check the path"});
    }
    Results results;
    try {
        const Json json = Json::parse(file);
        if (!json.at("format").get<std::string>().starts_with("grainbench-bench/")) {
            refuse(path, "its format is " + json.at("format").dump());
        }
        results.cpu = json.at("cpu_model");
        results.isa = json.at("isa");
        results.compiler = json.at("compiler");
        results.threads = json.at("threads");
        for (const Json& row : json.at("benchmarks")) {
            results.benchmarks.push_back(
                {row.at("name"), row.at("step_time"), row.at("step_time_median")});
        }
    } catch (const nlohmann::json::exception& error) {
        refuse(path, error.what());
    }
    return results;
}

const Timed* find(const Results& results, const std::string& name) {
    const auto found = std::find_if(results.benchmarks.begin(),
                                    results.benchmarks.end(),
                                    [&](const Timed& timed) { return timed.name == name; });
    return found == results.benchmarks.end() ? nullptr : &*found;
}

BenchVerdict verdict_of(const BenchChange& change, double threshold) {
    const double growth = change.ratio() - 1.0;
    if (std::abs(growth) <= change.noise) {
        return BenchVerdict::same;
    }
    if (growth < 0.0) {
        return BenchVerdict::faster;
    }
    return growth <= threshold ? BenchVerdict::slower : BenchVerdict::too_slow;
}

std::vector<std::string> cautions_of(const Results& before, const Results& after) {
    std::vector<std::string> cautions;
    const auto differ = [&](const char* what, const std::string& a, const std::string& b) {
        if (a != b) {
            cautions.push_back(fmt::format("{} differ: {} before, {} after", what, a, b));
        }
    };
    differ("processors", before.cpu, after.cpu);
    differ("instruction sets", before.isa, after.isa);
    differ("compilers", before.compiler, after.compiler);
    differ("threads", std::to_string(before.threads), std::to_string(after.threads));
    return cautions;
}

std::string name_of(BenchVerdict verdict) {
    return verdict_names[static_cast<std::size_t>(verdict)];
}

}  // namespace

BenchComparison compare_benchmarks(const std::filesystem::path& before,
                                   const std::filesystem::path& after,
                                   double threshold) {
    const Results old_results = read_results(before);
    const Results new_results = read_results(after);
    BenchComparison comparison;
    comparison.cautions = cautions_of(old_results, new_results);
    for (const Timed& old_one : old_results.benchmarks) {
        const Timed* new_one = find(new_results, old_one.name);
        if (new_one == nullptr) {
            comparison.only_old.push_back(old_one.name);
            continue;
        }
        BenchChange change{.name = old_one.name,
                           .before = old_one.least,
                           .after = new_one->least,
                           .noise = std::hypot(old_one.noise(), new_one->noise())};
        change.verdict = verdict_of(change, threshold);
        comparison.changes.push_back(change);
    }
    for (const Timed& new_one : new_results.benchmarks) {
        if (find(old_results, new_one.name) == nullptr) {
            comparison.only_new.push_back(new_one.name);
        }
    }
    if (comparison.changes.empty()) {
        throw_bad_input({.what = "the two results have no benchmark in common",
                         .where = before.string() + " and " + after.string(),
                         .likely_cause = "they were made with different filters",
                         .next_step = "run both with the same --filter"});
    }
    return comparison;
}

bool is_too_slow(const BenchComparison& comparison) {
    return std::any_of(
        comparison.changes.begin(), comparison.changes.end(), [](const BenchChange& change) {
            return change.verdict == BenchVerdict::too_slow;
        });
}

std::string to_text(const BenchComparison& comparison, double threshold) {
    std::string text = fmt::format("{:<36} {:>9} {:>9} {:>7} {:>7}  verdict\n",
                                   "benchmark, ns/step",
                                   "before",
                                   "after",
                                   "ratio",
                                   "noise");
    for (const BenchChange& change : comparison.changes) {
        text += fmt::format("{:<36} {:>9.2f} {:>9.2f} {:>7.3f} {:>6.1f}%  {}\n",
                            change.name,
                            1e9 * change.before,
                            1e9 * change.after,
                            change.ratio(),
                            100.0 * change.noise,
                            name_of(change.verdict));
    }
    for (const std::string& name : comparison.only_old) {
        text += fmt::format("{:<36} only in the first\n", name);
    }
    for (const std::string& name : comparison.only_new) {
        text += fmt::format("{:<36} only in the second\n", name);
    }
    for (const std::string& caution : comparison.cautions) {
        text += "caution: " + caution + "\n";
    }
    return text +
           (is_too_slow(comparison) ? "slower than the threshold of " : "none slower than ") +
           fmt::format(
               "{:g} %{}\n", 100.0 * threshold, is_too_slow(comparison) ? " allows" : " and noise");
}

std::string to_json(const BenchComparison& comparison, double threshold) {
    Json json{{"threshold", threshold},
              {"too_slow", is_too_slow(comparison)},
              {"only_old", comparison.only_old},
              {"only_new", comparison.only_new},
              {"cautions", comparison.cautions},
              {"benchmarks", Json::array()}};
    for (const BenchChange& change : comparison.changes) {
        json["benchmarks"].push_back({{"name", change.name},
                                      {"before", change.before},
                                      {"after", change.after},
                                      {"ratio", change.ratio()},
                                      {"noise", change.noise},
                                      {"verdict", name_of(change.verdict)}});
    }
    return io::pretty_text(json);
}

}  // namespace grainbench::cli
