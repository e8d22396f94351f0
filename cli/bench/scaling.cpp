#include "cli/bench/scaling.hpp"

#include "io/json/document.hpp"

#include "cli/bench/timing.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace grainbench::cli {

namespace {

using io::Json;

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

double wall_step_time(BenchRun& run) {
    const BenchTiming timing = run.time_one_span();
    return timing.wall_seconds / timing.particle_steps;
}

}  // namespace

double ScalingResult::speed_up() const {
    std::vector<double> ratios(alone.size());
    std::transform(
        alone.begin(), alone.end(), shared.begin(), ratios.begin(), [](double one, double several) {
            return one / several;
        });
    return median(std::move(ratios));
}

ScalingResult measure_scaling(const BenchCase& bench_case, unsigned threads) {
    BenchRun alone(bench_case);
    BenchRun shared(bench_case, threads);
    alone.prepare();
    shared.prepare();
    ScalingResult result{.name = bench_case.name,
                         .about = bench_case.about,
                         .isa = alone.simulation().isa(),
                         .particles = alone.simulation().particle_count(),
                         .alone = {},
                         .shared = {}};
    for (int repetition = 0; repetition < bench_case.repetitions; ++repetition) {
        result.alone.push_back(wall_step_time(alone));
        result.shared.push_back(wall_step_time(shared));
    }
    result.is_same_state = alone.simulation().state_hash() == shared.simulation().state_hash();
    return result;
}

std::string scaling_table(const BenchMachine& machine,
                          unsigned threads,
                          const std::vector<ScalingResult>& results) {
    std::string text =
        fmt::format("{}, {}, {}\n{}\n\n{:<36} {:>8} {:>10} {:>10} {:>9} {:>10}  {}\n",
                    machine.cpu_model,
                    results.empty() ? "none" : results.front().isa,
                    machine.compiler,
                    machine.program,
                    "ns/step on the wall, medians",
                    "balls",
                    "1 thread",
                    fmt::format("{} threads", threads),
                    "speed-up",
                    "efficiency",
                    "state");
    for (const ScalingResult& r : results) {
        text += fmt::format("{:<36} {:>8} {:>10.2f} {:>10.2f} {:>9.2f} {:>8.0f} %  {}\n",
                            r.name,
                            r.particles,
                            1e9 * median(r.alone),
                            1e9 * median(r.shared),
                            r.speed_up(),
                            100.0 * r.speed_up() / threads,
                            r.is_same_state ? "same bits" : "DIFFERS");
    }
    return text;
}

std::string scaling_json(const BenchMachine& machine,
                         unsigned threads,
                         const std::vector<ScalingResult>& results) {
    Json json{{"format", scaling_format},
              {"program", machine.program},
              {"cpu_model", machine.cpu_model},
              {"isa", results.empty() ? "none" : results.front().isa},
              {"compiler", machine.compiler},
              {"flags", machine.flags},
              {"threads", threads}};
    Json& rows = json["benchmarks"] = Json::array();
    for (const ScalingResult& r : results) {
        rows.push_back({{"name", r.name},
                        {"about", r.about},
                        {"particles", r.particles},
                        {"alone", r.alone},
                        {"shared", r.shared},
                        {"speed_up", r.speed_up()},
                        {"same_state", r.is_same_state}});
    }
    return io::pretty_text(json);
}

}  // namespace grainbench::cli
