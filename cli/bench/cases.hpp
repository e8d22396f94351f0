/// The scenes that `grainbench bench` times. Each is built in C++, so that a benchmark means the
/// same wherever the program is installed.
#pragma once

#include "core/scene.hpp"

#include <functional>
#include <string>
#include <vector>

namespace grainbench::cli {

struct BenchCase {
    std::string name;   ///< as `--filter` sees it
    std::string about;  ///< one line
    std::function<Scene()> scene;
    double prepared = 0.0;  ///< [s] simulated time before anything is timed
    double span = 0.0;      ///< [s] simulated time of one repetition
    int repetitions = 0;
    bool is_on_request = false;  ///< too long to run unasked: a filter must ask for it
};

/// All benchmarks, in the order of the report.
std::vector<BenchCase> bench_cases();

/// Small scenes whose instructions are counted under test (tests/performance): each effect on and
/// off. Times and repetitions are those of one count.
std::vector<BenchCase> counted_cases();

}  // namespace grainbench::cli
