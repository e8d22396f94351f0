/// What a study compares, read from run folders: for each realisation one curve over the same
/// points; a single number is a curve of one point.
#pragma once

#include "core/scene.hpp"
#include "core/statistics/curves.hpp"

#include "io/study.hpp"

#include "cli/jobs/job_pool.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace grainbench::cli {

struct Observation {
    std::vector<double> x;      ///< middle of each point; one point for a number
    statistics::Curves curves;  ///< of the realisations that have a value
    std::size_t missing = 0;    ///< realisations without one
};

/// Of a run that has finished. Curves hold what the history holds, also what is not finite.
Observation observe(const io::StudyObservable& observable,
                    const Scene& scene,
                    const JobResult& result);

/// How to speak of it. Numbers are shown in `unit`, which is `scale` times the SI unit.
struct Quantity {
    std::string name{};
    std::string unit{};
    double scale = 1.0;
    std::string x_name{};  ///< empty for a number
    std::string x_unit{};
};

/// \param any run of the study, for the units of history columns
Quantity quantity_of(const io::StudyObservable& observable, const JobResult& result);

}  // namespace grainbench::cli
