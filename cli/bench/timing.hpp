/// Times a benchmark: prepares its scene, then steps it and looks at the clock around
/// Simulation::advance only.
#pragma once

#include "core/simulation.hpp"

#include "cli/bench/cases.hpp"
#include "cli/bench/work_model.hpp"
#include "cli/phase_clock.hpp"

#include <optional>
#include <utility>

namespace grainbench::cli {

/// Sums over one repetition.
struct BenchTiming {
    double cpu_seconds = 0.0;   ///< of the thread, in Simulation::advance
    double wall_seconds = 0.0;  ///< the same by the clock on the wall
    double simulated = 0.0;     ///< [s]
    double cycles = 0.0;
    double particle_steps = 0.0;
    double touching = 0.0;  ///< sum over the cycles; so the next two
    double objects = 0.0;
    double candidates = 0.0;
    double loaded = 0.0;  ///< particles that touch anything; sampled more rarely
    double searches = 0.0;
    double candidate_builds = 0.0;
};

/// One running copy of a case; keeps its state from one repetition to the next.
class BenchRun {
public:
    /// \param threads that share the work on the scene
    explicit BenchRun(BenchCase bench_case, unsigned threads = 1)
        : case_(std::move(bench_case)), threads_(threads) {}

    /// Builds the scene and runs it to the time from which on it is timed, if not done yet.
    void prepare();

    BenchTiming time_one_span();

    /// Steps three more spans with a clock in them and keeps the quickest. The clock costs a few
    /// percent of small scenes, so that nothing else is timed meanwhile. Returns seconds on the
    /// wall per particle-step.
    PhaseTimes time_phases();

    const Simulation& simulation() const { return *simulation_; }

private:
    PhaseTimes time_phases_of_one_span();

    BenchCase case_;
    unsigned threads_;
    std::optional<Simulation> simulation_;
};

}  // namespace grainbench::cli
