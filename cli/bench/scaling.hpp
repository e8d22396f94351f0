/// What threads gain that share the work on one scene.
#pragma once

#include "cli/bench/cases.hpp"
#include "cli/bench_command.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace grainbench::cli {

inline constexpr const char* scaling_format = "grainbench-scaling/1";

/// Two copies of a benchmark stepped in turns, by one thread and by several.
struct ScalingResult {
    std::string name;
    std::string about;
    std::string isa;
    std::size_t particles = 0;
    std::vector<double> alone;   ///< [s] on the wall per particle-step of one thread, by repetition
    std::vector<double> shared;  ///< [s] the same of several threads, right after
    bool is_same_state = false;  ///< whether both copies hold the same bits in the end

    /// Median over the repetitions of the ratio of two neighbours: what slows the machine for a
    /// while slows both.
    double speed_up() const;
};

ScalingResult measure_scaling(const BenchCase& bench_case, unsigned threads);

std::string scaling_table(const BenchMachine& machine,
                          unsigned threads,
                          const std::vector<ScalingResult>& results);

std::string scaling_json(const BenchMachine& machine,
                         unsigned threads,
                         const std::vector<ScalingResult>& results);

}  // namespace grainbench::cli
