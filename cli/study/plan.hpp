/// From a study file to runs: one scene per variant, all with the same seeds, and for timing the
/// same scenes once more, cut short and without output.
#pragma once

#include "core/scene.hpp"

#include "io/study.hpp"

#include "cli/jobs/job_pool.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace grainbench::cli {

struct PlannedVariant {
    io::StudyVariant variant;
    Scene scene;
};

struct StudyPlan {
    io::Study study;  ///< with what --quick changes
    bool quick = false;
    std::filesystem::path scene_directory;
    std::vector<PlannedVariant> variants;
    std::size_t reference = 0;  ///< index into variants
};

/// Reads the scene of each variant. Throws Error(bad_input) that names the variant at fault.
/// \param directory that Study::scene is relative to
StudyPlan plan_study(io::Study study, const std::filesystem::path& directory, bool quick);

/// One per variant, in their order; then, if the study times, one timed per variant, and that as
/// often as it asks for.
std::vector<Job> jobs_of(const StudyPlan& plan);

/// From the first stage to the last [s].
double duration_of(const Scene& scene);

/// The scene for one of its realisations until `duration`, writing nothing on the way.
Scene scene_to_time(Scene scene, std::int64_t realisation, double duration);

}  // namespace grainbench::cli
