/// The charts of a study.
#pragma once

#include "render/chart.hpp"

#include "cli/study/result.hpp"

namespace grainbench::cli {

/// Means of all variants: curves with the 95 % band of the reference, or bars with intervals where
/// the observable is a number.
render::Chart overlay_chart(const StudyResult& result);

/// Deviation against speed-up, with 95 % intervals, the margin and the Pareto front.
render::Chart cost_chart(const StudyResult& result);

/// Half width of the interval of each deviation against the number of realisations. Without series
/// where the study does not ask for growth, or nothing differs.
render::Chart growth_chart(const StudyResult& result);

}  // namespace grainbench::cli
