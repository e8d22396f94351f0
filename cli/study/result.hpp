/// What a study found out, as numbers: what reports and charts are made of.
#pragma once

#include "core/statistics/curves.hpp"

#include "cli/study/observe.hpp"
#include "cli/study/plan.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace grainbench::cli {

/// What one realisation of a variant took, on average.
struct VariantCost {
    double cycles = 0.0;                       ///< [1]
    double particles = 0.0;                    ///< [1]
    double mean_timestep = 0.0;                ///< [s]
    double step_time = 0.0;                    ///< [s] of processor time per particle-step
    double parallel_step_time = 0.0;           ///< [s] the same in the runs side by side
    bool timed_alone = false;                  ///< where step_time comes from
    double seconds = 0.0;                      ///< [s] step_time for all its particle-steps
    double speed_up = 1.0;                     ///< [1] over the reference
    std::optional<double> published_speed_up;  ///< [1] over the reference's published time
};

/// The verdict that fewer realisations would have given.
struct GrowthStep {
    std::size_t realisations = 0;
    double deviation = 0.0;   ///< where it is largest
    double half_width = 0.0;  ///< of its 95 % interval
    statistics::Verdict verdict = statistics::Verdict::undecided;
};

struct VariantResult {
    std::string name;
    std::filesystem::path folder;
    bool unstable = false;
    std::string message;  ///< why
    std::optional<io::PublishedCost> published;
    VariantCost cost;
    double steps_per_contact = 0.0;  ///< [1] shortest contact time over mean step; 0 if unknown
    std::vector<std::string> warnings;

    Observation observation;
    std::vector<statistics::Estimate> mean;  ///< of the observable at each point
    // Over the reference; of no meaning for the reference itself.
    statistics::CurveDifference difference;
    double spreads = 0.0;  ///< [1] largest difference over the reference's deviation there
    statistics::Verdict verdict = statistics::Verdict::undecided;
    std::optional<std::size_t> needed;  ///< realisations that would decide
    std::vector<GrowthStep> growth;

    /// Where it is largest; all zero for a variant without values.
    statistics::Estimate largest() const {
        return difference.at.empty() ? statistics::Estimate{.value = 0.0}
                                     : difference.at[difference.largest];
    }
};

struct StudyResult {
    StudyPlan plan;
    Quantity quantity;
    std::vector<double> x;
    std::vector<VariantResult> variants;
    std::vector<std::size_t> pareto;  ///< variants that no other beats, cheapest first
    std::string recommendation;       ///< one sentence or two

    const VariantResult& reference() const { return variants[plan.reference]; }

    bool is_reference(const VariantResult& variant) const { return &variant == &reference(); }
};

/// \param results of jobs_of(plan), all ended
StudyResult analyse_study(StudyPlan plan, const std::vector<JobResult>& results);

}  // namespace grainbench::cli
