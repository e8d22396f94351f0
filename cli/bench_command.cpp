#include "cli/bench_command.hpp"

#include "core/error.hpp"

#include "io/atomic_file.hpp"

#include "cli/bench/cases.hpp"
#include "cli/bench/report.hpp"
#include "cli/bench/scaling.hpp"
#include "cli/bench/timing.hpp"

#include <benchmark/benchmark.h>

#include <cmath>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <regex>

namespace grainbench::cli {

namespace {

/// What the threads and repetitions of one benchmark share.
struct Shared {
    Shared(const BenchCase& bench_case, unsigned threads) : about(bench_case) {
        for (unsigned t = 0; t < threads; ++t) {
            runs.emplace_back(bench_case);
        }
    }

    BenchCase about;
    std::vector<BenchRun> runs;  ///< by thread
};

/// The first error of any benchmark: Google Benchmark lets none through.
class Failure {
public:
    void keep(std::exception_ptr error) {
        const std::lock_guard lock(mutex_);
        if (!error_) {
            error_ = std::move(error);
        }
    }

    bool happened() {
        const std::lock_guard lock(mutex_);
        return error_ != nullptr;
    }

    void rethrow() {
        if (error_) {
            std::rethrow_exception(error_);
        }
    }

private:
    std::mutex mutex_;
    std::exception_ptr error_;
};

/// Counters are summed over threads by Google Benchmark.
void run_one(benchmark::State& state, Shared& shared, Failure& failure) {
    BenchRun& run = shared.runs[static_cast<std::size_t>(state.thread_index())];
    if (failure.happened()) {
        state.SkipWithError("an earlier benchmark failed");
        return;
    }
    try {
        run.prepare();
    } catch (...) {
        failure.keep(std::current_exception());
        state.SkipWithError("the scene could not be prepared");
        return;
    }
    BenchTiming timing;
    for ([[maybe_unused]] auto _ : state) {
        try {
            timing = run.time_one_span();
            state.SetIterationTime(timing.cpu_seconds);
        } catch (...) {
            failure.keep(std::current_exception());
            state.SkipWithError("the simulation stopped");
            break;
        }
    }
    state.counters["cpu"] = timing.cpu_seconds;
    state.counters["wall"] = timing.wall_seconds;
    state.counters["simulated"] = timing.simulated;
    state.counters["cycles"] = timing.cycles;
    state.counters["particle_steps"] = timing.particle_steps;
    state.counters["touching"] = timing.touching;
    state.counters["objects"] = timing.objects;
    state.counters["candidates"] = timing.candidates;
    state.counters["loaded"] = timing.loaded;
    state.counters["searches"] = timing.searches;
    state.counters["builds"] = timing.candidate_builds;
}

/// Collects the repetitions of each benchmark.
class Collector : public benchmark::BenchmarkReporter {
public:
    explicit Collector(const std::map<std::string, std::shared_ptr<Shared>>& shared)
        : shared_(shared) {}

    bool ReportContext(const Context&) override { return true; }

    void ReportRuns(const std::vector<Run>& runs) override {
        BenchResult result;
        std::map<std::string, double> sums;
        for (const Run& run : runs) {
            if (run.run_type == Run::RT_Aggregate || run.error_occurred) {
                continue;
            }
            const auto count = [&](const char* name) { return run.counters.at(name).value; };
            for (const auto& [name, counter] : run.counters) {
                sums[name] += counter.value;
            }
            result.name = run.run_name.function_name;
            result.step_times.push_back(count("cpu") / count("particle_steps"));
            result.wall_step_times.push_back(count("wall") / count("particle_steps"));
            result.contact_times.push_back(count("cpu") / count("touching"));
        }
        if (result.step_times.empty()) {
            return;
        }
        const double steps = sums["particle_steps"];
        result.counts = {.particles = steps / sums["cycles"],
                         .touching = sums["touching"] / steps,
                         .loaded = sums["loaded"] / steps,
                         .objects = sums["objects"] / steps,
                         .candidates = sums["candidates"] / steps,
                         .renewals = sums["searches"] / sums["cycles"],
                         .builds = sums["builds"] / sums["cycles"]};
        result.timestep = sums["simulated"] / sums["cycles"];
        complete(*shared_.at(result.name), result);
        results.push_back(result);
    }

    std::vector<BenchResult> results;

private:
    /// Adds what is known when all repetitions are over, and what is measured then.
    static void complete(Shared& shared, BenchResult& result) {
        BenchRun& run = shared.runs.front();
        const Simulation& simulation = run.simulation();
        result.about = shared.about.about;
        result.isa = simulation.isa();
        const ParticleFrame frame = simulation.particle_frame();
        double squares = 0.0;
        for (const Vec3& v : frame.velocity) {
            squares += dot(v, v);
        }
        result.rms_speed = std::sqrt(squares / result.counts.particles);
        const Scene scene = shared.about.scene();
        const Stage& stage = scene.stages.back();
        result.work = work_of(
            result.counts,
            stage.contact.value_or(scene.contact),
            !std::holds_alternative<FixedTimestep>(stage.timestep.value_or(scene.timestep)));
        result.speed = measure_speed(result.isa, result.work.working_set);
        result.phases = run.time_phases();
    }

    const std::map<std::string, std::shared_ptr<Shared>>& shared_;
};

/// The report goes to the file as JSON, and to `out` as asked.
void write_report(const BenchArguments& arguments,
                  const std::string& json,
                  const std::string& table,
                  std::ostream& out) {
    if (!arguments.output.empty()) {
        io::write_file(arguments.output, json);
    }
    out << (arguments.json ? json : table);
}

int scaling_command(const BenchArguments& arguments,
                    const std::vector<BenchCase>& cases,
                    const BenchMachine& machine,
                    std::ostream& out,
                    std::ostream& err) {
    std::vector<ScalingResult> results;
    for (const BenchCase& bench_case : cases) {
        err << bench_case.name << ": " << bench_case.about << std::endl;
        results.push_back(measure_scaling(bench_case, arguments.scaling));
    }
    write_report(arguments,
                 scaling_json(machine, arguments.scaling, results),
                 scaling_table(machine, arguments.scaling, results),
                 out);
    return 0;
}

std::vector<BenchCase> chosen_cases(const std::string& filter) {
    std::vector<BenchCase> all = bench_cases();
    std::string names;
    for (const BenchCase& bench_case : all) {
        names += (names.empty() ? "" : ", ") + bench_case.name;
    }
    const auto refuse = [&](const std::string& what, const std::string& cause) {
        throw_bad_input({.what = what,
                         .where = "--filter " + filter,
                         .likely_cause = cause,
                         .next_step = "choose among: " + names});
    };
    try {
        const std::regex wanted(filter);
        std::erase_if(all, [&](const BenchCase& bench_case) {
            return !std::regex_search(bench_case.name, wanted);
        });
    } catch (const std::regex_error& error) {
        refuse("the filter is no regular expression", error.what());
    }
    if (filter.empty()) {
        std::erase_if(all, [](const BenchCase& bench_case) { return bench_case.is_on_request; });
    }
    if (all.empty()) {
        refuse("no benchmark has a name that matches", "a misspelt name");
    }
    return all;
}

}  // namespace

int bench_command(const BenchArguments& arguments,
                  const BenchMachine& machine,
                  std::ostream& out,
                  std::ostream& err) {
    const std::vector<BenchCase> cases = chosen_cases(arguments.filter);
    if (arguments.scaling > 0) {
        return scaling_command(arguments, cases, machine, out, err);
    }
    const unsigned threads = std::max(1U, arguments.threads);
    Failure failure;
    std::vector<BenchResult> results;
    for (const BenchCase& bench_case : cases) {
        err << bench_case.name << ": " << bench_case.about << std::endl;
        const std::map<std::string, std::shared_ptr<Shared>> shared{
            {bench_case.name, std::make_shared<Shared>(bench_case, threads)}};
        benchmark::ClearRegisteredBenchmarks();
        benchmark::RegisterBenchmark(bench_case.name.c_str(),
                                     [&failure, one = shared.begin()->second](auto& state) {
                                         run_one(state, *one, failure);
                                     })
            ->Iterations(1)
            ->Repetitions(bench_case.repetitions)
            ->Threads(static_cast<int>(threads))
            ->UseManualTime();
        Collector collector(shared);
        benchmark::RunSpecifiedBenchmarks(&collector, ".");
        failure.rethrow();
        results.insert(results.end(), collector.results.begin(), collector.results.end());
    }
    benchmark::ClearRegisteredBenchmarks();
    write_report(arguments,
                 bench_json(machine, threads, results),
                 bench_table(machine, threads, results),
                 out);
    return 0;
}

}  // namespace grainbench::cli
