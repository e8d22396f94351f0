#include "cli/bench/report.hpp"

#include "io/json/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace grainbench::cli {

namespace {

using io::Json;

double smallest(const std::vector<double>& values) {
    return *std::min_element(values.begin(), values.end());
}

std::string isa_of(const std::vector<BenchResult>& results) {
    return results.empty() ? "none" : results.front().isa;
}

/// Cycles from one event to the next; 0 where none happened.
double interval(double per_cycle) {
    return per_cycle > 0.0 ? 1.0 / per_cycle : 0.0;
}

std::string interval_text(double per_cycle) {
    return per_cycle > 0.0 ? fmt::format("{:.1f}", 1.0 / per_cycle) : "never";
}

std::string cost_table(const std::vector<BenchResult>& results) {
    std::string text = fmt::format(
        "{:<36} {:>7} {:>8} {:>8} {:>9} {:>8} {:>6} {:>6} {:>6} {:>9} {:>9}\n"
        "{:<36} {:>7} {:>8} {:>8} {:>9} {:>8} {:>6} {:>6} {:>6} {:>9} {:>9}\n",
        "",
        "",
        "ns/step",
        "ns/step",
        "Mstep/s",
        "ns/touch",
        "touch",
        "object",
        "candid",
        "cycles/",
        "cycles/",
        "benchmark",
        "balls",
        "min",
        "median",
        "per core",
        "min",
        "/ball",
        "/ball",
        "/ball",
        "search",
        "build");
    for (const BenchResult& r : results) {
        text += fmt::format(
            "{:<36} {:>7.0f} {:>8.2f} {:>8.2f} {:>9.2f} {:>8.2f} {:>6.2f} {:>6.2f} {:>6.2f} "
            "{:>9} {:>9}\n",
            r.name,
            r.counts.particles,
            1e9 * r.step_time(),
            1e9 * r.step_time_median(),
            1e-6 / r.step_time(),
            1e9 * smallest(r.contact_times),
            r.counts.touching,
            r.counts.objects,
            r.counts.candidates,
            interval_text(r.counts.renewals),
            interval_text(r.counts.builds));
    }
    return text;
}

std::string phase_table(const std::vector<BenchResult>& results) {
    std::string text = fmt::format("{:<36} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n{:<36}",
                                   "",
                                   "detection",
                                   "contacts",
                                   "walls",
                                   "integr.",
                                   "timestep",
                                   "output",
                                   "sum",
                                   "ns/step by phase, with a clock");
    text += "\n";
    for (const BenchResult& r : results) {
        const auto time = [&](Phase phase) {
            return 1e9 * r.phases[static_cast<std::size_t>(phase)];
        };
        text +=
            fmt::format("{:<36} {:>9.2f} {:>9.2f} {:>9.2f} {:>9.2f} {:>9.2f} {:>9.2f} {:>9.2f}\n",
                        r.name,
                        time(Phase::detection),
                        time(Phase::contacts),
                        time(Phase::walls),
                        time(Phase::integration),
                        time(Phase::timestep),
                        time(Phase::output),
                        1e9 * std::accumulate(r.phases.begin(), r.phases.end(), 0.0));
    }
    return text;
}

std::string roofline_table(const std::vector<BenchResult>& results) {
    std::string text = fmt::format(
        "{:<36} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>10}\n"
        "{:<36} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>10}\n",
        "",
        "B",
        "flop",
        "set",
        "triad",
        "peak",
        "bound",
        "fraction",
        "roofline",
        "/step",
        "/step",
        "MB",
        "GB/s",
        "Gflop/s",
        "ns/step",
        "of roof");
    for (const BenchResult& r : results) {
        text += fmt::format("{:<36} {:>9.1f} {:>9.1f} {:>9.2f} {:>9.1f} {:>9.1f} {:>9.2f} {:>10}\n",
                            r.name,
                            r.work.bytes,
                            r.work.operations,
                            1e-6 * r.work.working_set,
                            1e-9 * r.speed.bandwidth,
                            1e-9 * r.speed.peak,
                            1e9 * r.roofline_fraction() * r.step_time(),
                            fmt::format("{:.0f} % {}",
                                        100.0 * r.roofline_fraction(),
                                        r.is_bandwidth_bound() ? "mem" : "flop"));
    }
    return text;
}

Json json_of(const BenchResult& r) {
    Json phases;
    for (std::size_t k = 0; k < phase_count; ++k) {
        phases[phase_names[k]] = r.phases[k];
    }
    return {{"name", r.name},
            {"about", r.about},
            {"particles", r.counts.particles},
            {"timestep", r.timestep},
            {"rms_speed", r.rms_speed},
            {"step_time", r.step_time()},
            {"step_time_median", r.step_time_median()},
            {"step_times", r.step_times},
            {"wall_step_times", r.wall_step_times},
            {"touching_contact_time", smallest(r.contact_times)},
            {"particle_steps_per_second", 1.0 / r.step_time()},
            {"touching", r.counts.touching},
            {"loaded", r.counts.loaded},
            {"objects", r.counts.objects},
            {"candidates", r.counts.candidates},
            {"search_interval", interval(r.counts.renewals)},
            {"candidate_build_interval", interval(r.counts.builds)},
            {"phases", phases},
            {"roofline",
             {{"bytes", r.work.bytes},
              {"operations", r.work.operations},
              {"working_set", r.work.working_set},
              {"bandwidth", r.speed.bandwidth},
              {"peak", r.speed.peak},
              {"bound", r.is_bandwidth_bound() ? "bandwidth" : "peak"},
              {"fraction", r.roofline_fraction()}}}};
}

}  // namespace

double BenchResult::step_time() const {
    return smallest(step_times);
}

double BenchResult::step_time_median() const {
    std::vector<double> values = step_times;
    std::sort(values.begin(), values.end());
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

double BenchResult::roofline_fraction() const {
    return std::max(work.bytes / speed.bandwidth, work.operations / speed.peak) / step_time();
}

bool BenchResult::is_bandwidth_bound() const {
    return work.bytes / speed.bandwidth > work.operations / speed.peak;
}

std::string bench_table(const BenchMachine& machine,
                        unsigned threads,
                        const std::vector<BenchResult>& results) {
    return fmt::format("{}, {}, {}, {} thread{}\n{}\n\n",
                       machine.cpu_model,
                       isa_of(results),
                       machine.compiler,
                       threads,
                       threads == 1 ? "" : "s",
                       machine.program) +
           cost_table(results) + "\n" + phase_table(results) + "\n" + roofline_table(results);
}

std::string bench_json(const BenchMachine& machine,
                       unsigned threads,
                       const std::vector<BenchResult>& results) {
    Json json{{"format", bench_format},
              {"program", machine.program},
              {"cpu_model", machine.cpu_model},
              {"isa", isa_of(results)},
              {"compiler", machine.compiler},
              {"flags", machine.flags},
              {"threads", threads}};
    Json& rows = json["benchmarks"] = Json::array();
    for (const BenchResult& result : results) {
        rows.push_back(json_of(result));
    }
    return io::pretty_text(json);
}

}  // namespace grainbench::cli
