/// What `grainbench bench` says: a table to read and JSON to keep.
#pragma once

#include "cli/bench_command.hpp"

#include <string>
#include <vector>

namespace grainbench::cli {

/// Outcome of one benchmark; counts are means over all repetitions and threads.
struct BenchResult {
    std::string name;
    std::string about;
    std::string isa;
    double particles = 0.0;               ///< [1]
    double timestep = 0.0;                ///< [s] mean
    double rms_speed = 0.0;               ///< [m/s] at the end, from the kinetic energy
    std::vector<double> step_times;       ///< [s] CPU time per particle-step, by repetition
    std::vector<double> contact_times;    ///< [s] CPU time per touching contact and cycle
    std::vector<double> wall_step_times;  ///< [s] time on the wall per particle-step
    double touching = 0.0;                ///< per particle
    double objects = 0.0;                 ///< per particle
    double candidates = 0.0;              ///< per particle
    double searches = 0.0;                ///< per cycle
    double candidate_builds = 0.0;        ///< per cycle
};

std::string bench_table(const BenchMachine& machine,
                        unsigned threads,
                        const std::vector<BenchResult>& results);

std::string bench_json(const BenchMachine& machine,
                       unsigned threads,
                       const std::vector<BenchResult>& results);

}  // namespace grainbench::cli
