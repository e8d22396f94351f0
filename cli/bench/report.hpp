/// What `grainbench bench` says: tables to read and JSON to keep.
#pragma once

#include "cli/bench/machine.hpp"
#include "cli/bench/timing.hpp"
#include "cli/bench/work_model.hpp"
#include "cli/bench_command.hpp"

#include <string>
#include <vector>

namespace grainbench::cli {

inline constexpr const char* bench_format = "grainbench-bench/2";

/// Outcome of one benchmark; counts are means over all repetitions and threads.
struct BenchResult {
    std::string name;
    std::string about;
    std::string isa;
    double timestep = 0.0;                ///< [s] mean
    double rms_speed = 0.0;               ///< [m/s] at the end, from the kinetic energy
    std::vector<double> step_times;       ///< [s] CPU time per particle-step, by repetition
    std::vector<double> contact_times;    ///< [s] CPU time per touching contact and cycle
    std::vector<double> wall_step_times;  ///< [s] time on the wall per particle-step
    WorkCounts counts;
    Work work;
    MachineSpeed speed;   ///< measured after the repetitions, over the working set of the scene
    PhaseTimes phases{};  ///< [s] per particle-step, from a span of its own

    double step_time() const;         ///< [s] least
    double step_time_median() const;  ///< [s]

    /// Least time that bytes and operations allow, over the least time measured.
    double roofline_fraction() const;
    bool is_bandwidth_bound() const;
};

std::string bench_table(const BenchMachine& machine,
                        unsigned threads,
                        const std::vector<BenchResult>& results);

std::string bench_json(const BenchMachine& machine,
                       unsigned threads,
                       const std::vector<BenchResult>& results);

}  // namespace grainbench::cli
