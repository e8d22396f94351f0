#include "core/error.hpp"
#include "core/statistics/pareto.hpp"

#include "cli/check_report.hpp"
#include "cli/jobs/planned_steps.hpp"
#include "cli/study/recommend.hpp"
#include "cli/study/result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grainbench::cli {
namespace {

using statistics::Curves;

/// \param timed step times of runs alone [s]; empty if there were none
VariantCost cost_of(const io::Manifest& manifest, const std::vector<double>& timed) {
    VariantCost cost;
    double steps = 0.0;
    double all_cpu = 0.0;
    double all_timed = 0.0;
    const auto count = static_cast<double>(manifest.realisations.size());
    for (const io::RealisationManifest& realisation : manifest.realisations) {
        const auto particles = static_cast<double>(realisation.particles);
        const auto cycles = static_cast<double>(realisation.cycles);
        cost.cycles += cycles / count;
        cost.particles += particles / count;
        cost.mean_timestep += realisation.summary.mean_timestep / count;
        steps += particles * cycles / count;
        all_cpu += realisation.cpu_seconds;
        all_timed += particles * static_cast<double>(realisation.timed_cycles);
    }
    cost.parallel_step_time = all_timed > 0.0 ? all_cpu / all_timed : 0.0;
    cost.timed_alone = !timed.empty();
    cost.step_time =
        timed.empty() ? cost.parallel_step_time : *std::min_element(timed.begin(), timed.end());
    cost.seconds = cost.step_time * steps;
    return cost;
}

Curves first(const Curves& curves, std::size_t count) {
    return {curves.begin(),
            curves.begin() + static_cast<std::ptrdiff_t>(std::min(count, curves.size()))};
}

bool is_finite(const Curves& curves) {
    for (const std::vector<double>& curve : curves) {
        for (const double value : curve) {
            if (!std::isfinite(value)) {
                return false;
            }
        }
    }
    return true;
}

void compare(VariantResult& variant, const VariantResult& reference, const io::Study& study) {
    const bool paired = study.comparison == io::Comparison::paired &&
                        variant.observation.missing + reference.observation.missing == 0;
    const Curves& ours = variant.observation.curves;
    const Curves& theirs = reference.observation.curves;
    if (ours.empty() || theirs.empty()) {
        return;
    }
    variant.difference = statistics::curve_difference(ours, theirs, paired);
    variant.verdict = statistics::verdict_of(variant.difference, study.margin);
    if (variant.verdict == statistics::Verdict::undecided) {
        variant.needed = statistics::realisations_to_decide(
            variant.difference, std::min(ours.size(), theirs.size()), study.margin);
    }
    const double spread =
        statistics::sample_of(statistics::values_at(theirs, variant.difference.largest)).deviation;
    variant.spreads = spread > 0.0 ? variant.largest().value / spread : 0.0;
    for (const std::int64_t n : study.growth) {
        const auto count = static_cast<std::size_t>(n);
        const statistics::CurveDifference difference =
            statistics::curve_difference(first(ours, count), first(theirs, count), paired);
        const statistics::Estimate at = difference.at[difference.largest];
        const statistics::Interval interval = statistics::interval_of(at, 0.95);
        variant.growth.push_back({.realisations = count,
                                  .deviation = at.value,
                                  .half_width = 0.5 * (interval.high - interval.low),
                                  .verdict = statistics::verdict_of(difference, study.margin)});
    }
}

void relate_costs(StudyResult& result) {
    const VariantResult& reference = result.reference();
    for (VariantResult& variant : result.variants) {
        if (variant.cost.seconds > 0.0) {
            variant.cost.speed_up = reference.cost.seconds / variant.cost.seconds;
        }
        if (variant.published && reference.published) {
            variant.cost.published_speed_up =
                reference.published->seconds / variant.published->seconds;
        }
    }
}

std::vector<std::size_t> front_of(const StudyResult& result) {
    std::vector<std::size_t> candidates;
    std::vector<statistics::CostAndError> points;
    for (std::size_t k = 0; k < result.variants.size(); ++k) {
        const VariantResult& variant = result.variants[k];
        if (!variant.unstable && !variant.observation.curves.empty()) {
            candidates.push_back(k);
            points.push_back(
                {.cost = variant.cost.seconds,
                 .error = result.is_reference(variant) ? 0.0 : std::abs(variant.largest().value)});
        }
    }
    std::vector<std::size_t> front;
    for (const std::size_t k : statistics::pareto_front(points)) {
        front.push_back(candidates[k]);
    }
    return front;
}

}  // namespace

StudyResult analyse_study(StudyPlan plan, const std::vector<JobResult>& results) {
    StudyResult result;
    const std::size_t count = plan.variants.size();
    for (std::size_t k = 0; k < count; ++k) {
        const io::Manifest& manifest = results[k].manifest;
        const Scene& scene = plan.variants[k].scene;
        VariantResult variant;
        variant.name = plan.variants[k].variant.name;
        variant.published = plan.variants[k].variant.published;
        variant.folder = results[k].folder;
        variant.warnings = opening_warnings(scene);
        variant.unstable = manifest.outcome == "unstable";
        variant.message = manifest.message;
        std::vector<double> timed;
        for (std::size_t job = count + k; job < results.size() && !variant.unstable; job += count) {
            timed.push_back(results[job].manifest.realisations.at(0).step_time());
        }
        variant.cost = cost_of(manifest, timed);
        const double contact = shortest_contact(scene);
        if (std::isfinite(contact) && variant.cost.mean_timestep > 0.0) {
            variant.steps_per_contact = contact / variant.cost.mean_timestep;
        }
        if (!variant.unstable) {
            variant.observation = observe(plan.study.observable, scene, results[k]);
            if (!is_finite(variant.observation.curves)) {
                variant.unstable = true;
                variant.message = "what is compared is no finite number";
                variant.observation.curves.clear();
            }
            variant.mean = statistics::mean_curve(variant.observation.curves);
        }
        result.variants.push_back(std::move(variant));
    }
    if (result.variants[plan.reference].unstable) {
        throw_bad_input({.what = "the reference of the study is unstable: " +
                                 result.variants[plan.reference].message,
                         .where = "variant '" + plan.study.reference + "'",
                         .likely_cause = "its step is too long for its stiffness",
                         .next_step = "choose a finer reference"});
    }
    result.plan = std::move(plan);
    result.quantity = quantity_of(result.plan.study.observable, results[result.plan.reference]);
    result.x = result.reference().observation.x;
    for (VariantResult& variant : result.variants) {
        if (!result.is_reference(variant) && !variant.unstable) {
            compare(variant, result.reference(), result.plan.study);
        }
    }
    relate_costs(result);
    result.pareto = front_of(result);
    result.recommendation = recommendation_of(result);
    return result;
}

}  // namespace grainbench::cli
