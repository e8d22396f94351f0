/// From runs to charts: takes the numbers that a figure of a set asks for out of histories,
/// manifests and scenes.
#pragma once

#include "core/scene.hpp"

#include "io/history.hpp"
#include "io/manifest.hpp"

#include "render/chart.hpp"

#include "cli/figures/figure_set.hpp"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace grainbench::cli {

/// A run of a set as it was done. What no figure asks for may be missing.
struct ShownRun {
    std::string label;
    std::size_t look = 0;
    Scene scene;
    io::Manifest manifest;
    io::History history;
};

using ShownRuns = std::map<std::string, ShownRun>;

/// The chart of a figure. Error(bad_input) names the figure and the column or wall that there is
/// not.
render::Chart chart_of(const ChartFigure& figure, const ShownRuns& runs);

/// A column over time.
struct TimeSeries {
    std::vector<double> time;  ///< [s] ascending
    std::vector<double> value;
};

/// A column of a history from begin to end, without what is not a number.
/// \param period 0, or the length of the intervals that the column holds averages of: one point at
/// the end of each. The average of an interval stands in the rows of the next one.
TimeSeries time_series(const io::HistoryTable& history,
                       const std::string& column,
                       double period,
                       double begin,
                       double end);

/// Mean of several series and its spread, at the times of the first one that all of them reach.
struct MeanSeries {
    std::vector<double> time;
    std::vector<double> mean;
    std::vector<double> deviation;  ///< sample standard deviation; 0 for one series
};

MeanSeries mean_series(const std::vector<TimeSeries>& series);

}  // namespace grainbench::cli
