#include "cli/bench/report.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace grainbench::cli {

namespace {

double smallest(const std::vector<double>& values) {
    return *std::min_element(values.begin(), values.end());
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

/// A JSON string; our names and those of processors hold nothing else that needs an escape.
std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') {
            result += '\\';
        }
        result += c;
    }
    return result + "\"";
}

std::string list(const std::vector<double>& values) {
    return fmt::format("[{:.6g}]", fmt::join(values, ", "));
}

std::string isa_of(const std::vector<BenchResult>& results) {
    return results.empty() ? "none" : results.front().isa;
}

}  // namespace

std::string bench_table(const BenchMachine& machine,
                        unsigned threads,
                        const std::vector<BenchResult>& results) {
    std::string text = fmt::format("{}, {}, {}, {} thread{}\n\n",
                                   machine.cpu_model,
                                   isa_of(results),
                                   machine.compiler,
                                   threads,
                                   threads == 1 ? "" : "s");
    text += fmt::format("{:<36} {:>7} {:>7} {:>7} {:>8} {:>8} {:>6} {:>6} {:>6} {:>9} {:>9}\n",
                        "",
                        "",
                        "ns/step",
                        "ns/step",
                        "Mstep/s",
                        "ns/touch",
                        "touch",
                        "object",
                        "candid",
                        "searches",
                        "builds");
    text += fmt::format("{:<36} {:>7} {:>7} {:>7} {:>8} {:>8} {:>6} {:>6} {:>6} {:>9} {:>9}\n",
                        "benchmark",
                        "balls",
                        "min",
                        "median",
                        "per core",
                        "min",
                        "/ball",
                        "/ball",
                        "/ball",
                        "/cycle",
                        "/cycle");
    for (const BenchResult& r : results) {
        text += fmt::format(
            "{:<36} {:>7.0f} {:>7.2f} {:>7.2f} {:>8.2f} {:>8.2f} {:>6.2f} {:>6.2f} {:>6.2f} "
            "{:>9.5f} {:>9.5f}\n",
            r.name,
            r.particles,
            1e9 * smallest(r.step_times),
            1e9 * median(r.step_times),
            1e-6 / smallest(r.step_times),
            1e9 * smallest(r.contact_times),
            r.touching,
            r.objects,
            r.candidates,
            r.searches,
            r.candidate_builds);
    }
    return text;
}

std::string bench_json(const BenchMachine& machine,
                       unsigned threads,
                       const std::vector<BenchResult>& results) {
    std::string text = fmt::format(
        "{{\n  \"format\": \"grainbench-bench/1\",\n  \"cpu_model\": {},\n  \"isa\": {},\n  "
        "\"compiler\": {},\n  \"threads\": {},\n  \"benchmarks\": [",
        quoted(machine.cpu_model),
        quoted(isa_of(results)),
        quoted(machine.compiler),
        threads);
    const char* separator = "\n";
    for (const BenchResult& r : results) {
        text += separator;
        separator = ",\n";
        text += fmt::format(
            "    {{\n      \"name\": {},\n      \"about\": {},\n      \"particles\": {:.0f},\n"
            "      \"timestep\": {:.6g},\n      \"rms_speed\": {:.6g},\n"
            "      \"step_time\": {:.6g},\n      \"step_time_median\": {:.6g},\n"
            "      \"step_times\": {},\n      \"wall_step_times\": {},\n"
            "      \"touching_contact_time\": {:.6g},\n"
            "      \"particle_steps_per_second\": {:.6g},\n",
            quoted(r.name),
            quoted(r.about),
            r.particles,
            r.timestep,
            r.rms_speed,
            smallest(r.step_times),
            median(r.step_times),
            list(r.step_times),
            list(r.wall_step_times),
            smallest(r.contact_times),
            1.0 / smallest(r.step_times));
        text += fmt::format(
            "      \"touching\": {:.6g},\n      \"objects\": {:.6g},\n"
            "      \"candidates\": {:.6g},\n      \"searches_per_cycle\": {:.6g},\n"
            "      \"candidate_builds_per_cycle\": {:.6g}\n    }}",
            r.touching,
            r.objects,
            r.candidates,
            r.searches,
            r.candidate_builds);
    }
    return text + "\n  ]\n}\n";
}

}  // namespace grainbench::cli
