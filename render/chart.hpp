/// Charts as plain descriptions: what is drawn, with units; how is decided in one place, so that
/// all charts of a set look alike. Drawn by VTK charts, without a display.
///
///     Chart chart;
///     chart.x = {.label = "time", .unit = "s"};
///     chart.y = {.label = "elevation", .unit = "cm"};
///     chart.series.push_back({.name = "run 1", .x = times, .y = heights});
///     write_chart(chart, "out/elevation", {});  // elevation.png, elevation.svg, elevation.csv
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace grainbench::render {

enum class AxisScale { linear, logarithmic };

struct ChartAxis {
    std::string label{};
    std::string unit{};  ///< "" or "1" for a pure number
    AxisScale scale = AxisScale::linear;
    std::optional<double> low{};   ///< absent = from the data
    std::optional<double> high{};  ///< absent = from the data
};

enum class SeriesKind {
    line,    ///< through all points; gaps where y is not a number
    band,    ///< a line through y and a shade from low to high
    points,  ///< markers, with error bars from low to high if those are given
    bars     ///< one bar for each category, with error bars if those are given
};

/// One set of numbers with one entry in the legend.
struct ChartSeries {
    std::string name{};  ///< in the legend; empty = not there
    SeriesKind kind = SeriesKind::line;
    std::vector<double> x{};     ///< of bars: nothing, they stand at their category
    std::vector<double> y{};     ///< as many as x
    std::vector<double> low{};   ///< lower end of band or error bar; empty or as many as y
    std::vector<double> high{};  ///< upper end
    /// A line or a band: heavy, undashed and without markers, so that it stands out among others.
    bool is_heavy = false;
    /// Entry in the table of colours, dashes and markers; absent = place among the series. Give the
    /// same number to what is the same thing in several charts.
    std::optional<std::size_t> look{};
};

/// A dashed line over the whole height, with a word beside it.
struct VerticalLine {
    double x = 0.0;
    std::string text;
};

/// Text whose lower left corner stands at a point of the chart.
struct ChartText {
    double x = 0.0;
    double y = 0.0;
    std::string text;
};

struct Chart {
    std::string title;  ///< empty = none
    ChartAxis x;
    ChartAxis y;
    std::vector<std::string> categories;  ///< labels below the bars, at x = 0, 1, 2, ...
    std::vector<ChartSeries> series;
    std::vector<VerticalLine> vertical_lines;
    std::vector<ChartText> texts;
    int width = 1200;  ///< pixels; text and lines grow with it
    int height = 750;  ///< pixels
};

/// Words and values that go into the files, as text chunks of the PNG and as the description of
/// the SVG.
using ChartProvenance = std::vector<std::pair<std::string, std::string>>;

/// Writes stem.png, stem.svg and, with the numbers drawn, stem.csv. The same chart gives the same
/// bytes. Throws Error(bad_input) for a chart that cannot be drawn: columns that differ in length,
/// no number at all, or a logarithmic axis with none above zero.
void write_chart(const Chart& chart,
                 const std::filesystem::path& stem,
                 const ChartProvenance& provenance);

/// The numbers of a chart: one row for each point, with the columns series, x, y, low and high.
std::string chart_csv(const Chart& chart);

}  // namespace grainbench::render
