/// Where numbers lie on the axes of a chart: ranges from data, and ticks at round numbers. Knows no
/// VTK.
#pragma once

#include "render/chart.hpp"

#include <string>
#include <vector>

namespace grainbench::render {

/// One axis with its range fixed. `place` maps a number to where the axis counts evenly: itself, or
/// its decimal logarithm.
struct AxisRange {
    AxisScale scale = AxisScale::linear;
    double low = 0.0;   ///< as placed
    double high = 1.0;  ///< as placed

    /// Not a number for what a logarithmic axis cannot hold.
    double place(double value) const;
};

struct Tick {
    double place = 0.0;
    std::string label;  ///< empty = a tick without number
};

/// Ranges over all series, bands and error bars, with a margin where the axis does not say.
struct ChartRanges {
    AxisRange x;
    AxisRange y;
};

/// Error(bad_input) if there is nothing to draw, or the axes say low >= high.
ChartRanges ranges_of(const Chart& chart);

/// About `wanted` ticks at multiples of 1, 2 or 5, or at powers of ten.
std::vector<Tick> ticks_of(const AxisRange& range, int wanted);

/// Ticks at 0, 1, 2, ... with these labels.
std::vector<Tick> ticks_of(const std::vector<std::string>& categories);

/// Shortest text with as many decimals as steps of this size need: "0.25", "1200", "2e-5".
std::string tick_text(double value, double step);

}  // namespace grainbench::render
