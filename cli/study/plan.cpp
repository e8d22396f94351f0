#include "cli/study/plan.hpp"

#include "core/error.hpp"

#include "io/json/scene_json.hpp"

#include <algorithm>
#include <limits>

namespace grainbench::cli {
namespace {

/// What --quick leaves of a study.
io::Study quickened(io::Study study) {
    const io::StudyQuick quick = study.quick.value_or(io::StudyQuick{});
    study.realisations = std::min(study.realisations, quick.realisations);
    std::erase_if(study.growth, [&](std::int64_t n) { return n > study.realisations; });
    if (study.timing) {
        study.timing = io::StudyTiming{.duration = {}, .repetitions = 1};
    }
    if (!quick.variants.empty()) {
        std::vector<io::StudyVariant> kept = io::variants_of(study);
        std::erase_if(kept, [&](const io::StudyVariant& variant) {
            return variant.name != study.reference &&
                   std::find(quick.variants.begin(), quick.variants.end(), variant.name) ==
                       quick.variants.end();
        });
        study.variants = std::move(kept);
        study.axes.clear();
    }
    return study;
}

/// \param more changes that --quick makes
Scene scene_of(const io::Study& study,
               const io::StudyVariant& variant,
               const std::vector<std::string>& more,
               const std::filesystem::path& file) {
    std::vector<std::string> changes = study.set;
    changes.insert(changes.end(), variant.set.begin(), variant.set.end());
    changes.insert(changes.end(), more.begin(), more.end());
    changes.push_back("/realisations/count=" + std::to_string(study.realisations));
    try {
        return io::read_scene(file, changes);
    } catch (const Error& error) {
        Diagnosis diagnosis = error.diagnosis();
        diagnosis.where = "variant '" + variant.name + "': " + diagnosis.where;
        throw Error(error.kind(), diagnosis);
    }
}

void check_observable(const io::Study& study, const Scene& scene) {
    const bool needs_elevation = std::holds_alternative<io::ElevationCurve>(study.observable) ||
                                 std::holds_alternative<io::EntrainmentTime>(study.observable);
    if (needs_elevation && !scene.observables.elevation) {
        throw_bad_input({.what = "the scene does not measure the elevation that the study compares",
                         .where = study.scene + ": /observables/elevation",
                         .likely_cause = "the study belongs to another scene",
                         .next_step = "add the observable to the scene, or choose another "
                                      "observable in the study"});
    }
}

}  // namespace

double duration_of(const Scene& scene) {
    double duration = 0.0;
    for (const Stage& stage : scene.stages) {
        duration += stage.duration;
    }
    return duration;
}

Scene scene_to_time(Scene scene, std::int64_t realisation, double duration) {
    scene.realisations.count = 1;
    scene.realisations.seed += realisation;
    scene.output = {};
    scene.traces.clear();
    double begin = 0.0;
    for (Stage& stage : scene.stages) {
        stage.output.reset();
        stage.duration = std::clamp(duration - begin, 0.0, stage.duration);
        begin += stage.duration;
    }
    return scene;
}

StudyPlan plan_study(io::Study study, const std::filesystem::path& directory, bool quick) {
    StudyPlan plan;
    plan.quick = quick;
    std::vector<std::string> more;
    if (quick) {
        more = study.quick ? study.quick->set : std::vector<std::string>{};
        study = quickened(std::move(study));
    }
    plan.study = std::move(study);
    const std::filesystem::path file = directory / plan.study.scene;
    plan.scene_directory = file.parent_path();
    for (const io::StudyVariant& variant : io::variants_of(plan.study)) {
        if (variant.name == plan.study.reference) {
            plan.reference = plan.variants.size();
        }
        plan.variants.push_back({variant, scene_of(plan.study, variant, more, file)});
    }
    check_observable(plan.study, plan.variants.at(plan.reference).scene);
    return plan;
}

std::vector<Job> jobs_of(const StudyPlan& plan) {
    std::vector<Job> jobs;
    for (const PlannedVariant& planned : plan.variants) {
        jobs.push_back({.name = "variant '" + planned.variant.name + "'",
                        .scene = planned.scene,
                        .directory = plan.scene_directory});
    }
    if (!plan.study.timing) {
        return jobs;
    }
    const double duration =
        plan.study.timing->duration.value_or(std::numeric_limits<double>::infinity());
    for (std::int64_t n = 0; n < plan.study.timing->repetitions; ++n) {
        for (const PlannedVariant& planned : plan.variants) {
            jobs.push_back({.name = "timing of variant '" + planned.variant.name + "'",
                            .scene = scene_to_time(planned.scene, n, duration),
                            .directory = plan.scene_directory,
                            .timed = true});
        }
    }
    return jobs;
}

}  // namespace grainbench::cli
