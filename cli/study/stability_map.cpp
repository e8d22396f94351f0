#include "cli/study/stability_map.hpp"

#include "core/verify/work_precision.hpp"

#include "io/atomic_file.hpp"

#include "cli/build_info.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace grainbench::cli {
namespace {

using render::AxisScale;
using render::Chart;
using render::ChartSeries;
using render::SeriesKind;

/// Classes of the error of the energy, each with a colour.
struct ErrorClass {
    double limit;
    const char* name;
    std::size_t look;  ///< of the series that stands for it
};

constexpr std::array classes{ErrorClass{0.01, "error below 1 %", 2},
                             ErrorClass{0.1, "1 to 10 %", 4},
                             ErrorClass{0.3, "10 to 30 %", 0},
                             ErrorClass{std::numeric_limits<double>::infinity(), "over 30 %", 1}};

constexpr std::size_t look_of_growth = 3;
constexpr std::size_t look_of_theory = 6;

std::vector<double> grid(double first, double last, int count) {
    std::vector<double> values;
    for (int k = 0; k < count; ++k) {
        values.push_back(first + (last - first) * k / (count - 1));
    }
    return values;
}

/// Whether the point lies on the side of (2) that the theory says.
bool is_as_expected(const verify::MapPoint& point) {
    return point.grows == (point.step >= verify::critical_step_ratio(point.damping));
}

}  // namespace

StabilityMapResult study_stability_map(bool quick) {
    std::vector<double> timesteps{10e-6, 20e-6};
    if (!quick) {
        timesteps = {
            2e-6, 3e-6, 4e-6, 6e-6, 8e-6, 10e-6, 12.5e-6, 16e-6, 20e-6, 25e-6, 30e-6, 35e-6, 40e-6};
    }
    return {verify::stability_map(grid(0.0, 1.0, quick ? 6 : 26), grid(0.05, 1.25, quick ? 7 : 25)),
            verify::shaken_bed_errors(timesteps),
            verify::shaken_bed_automatic_step()};
}

Chart map_chart(const StabilityMapResult& result) {
    Chart chart;
    chart.title = "One contact: error of the energy by step and damping";
    chart.x = {.label = "damping ratio", .low = -0.03, .high = 1.45};
    chart.y = {.label = "step over the undamped critical step", .low = 0.0, .high = 1.3};
    double least = 0.0;
    for (const ErrorClass& one : classes) {
        ChartSeries series{.name = one.name, .kind = SeriesKind::points, .look = one.look};
        for (const verify::MapPoint& point : result.map) {
            if (!point.grows && point.energy_error >= least && point.energy_error < one.limit) {
                series.x.push_back(point.damping);
                series.y.push_back(point.step);
            }
        }
        least = one.limit;
        chart.series.push_back(std::move(series));
    }
    ChartSeries growth{.name = "grows", .kind = SeriesKind::points, .look = look_of_growth};
    for (const verify::MapPoint& point : result.map) {
        if (point.grows) {
            growth.x.push_back(point.damping);
            growth.y.push_back(point.step);
        }
    }
    chart.series.push_back(std::move(growth));
    ChartSeries theory{.name = "sqrt(1 + b^2) - b", .is_heavy = true, .look = look_of_theory};
    for (const double damping : grid(0.0, 1.0, 101)) {
        theory.x.push_back(damping);
        theory.y.push_back(verify::critical_step_ratio(damping));
    }
    chart.series.push_back(std::move(theory));
    return chart;
}

Chart bed_chart(const StabilityMapResult& result) {
    Chart chart;
    chart.title = "A shaken bed: energy that the step makes or loses";
    chart.x = {.label = "timestep", .unit = "us", .scale = AxisScale::logarithmic};
    chart.y = {.label = "energy of the integrator",
               .unit = "% of what is dissipated",
               .scale = AxisScale::logarithmic};
    ChartSeries series{.name = "125 balls in a shaken box"};
    ChartSeries square{.name = "slope 2"};
    for (const verify::BedPoint& point : result.bed) {
        series.x.push_back(1e6 * point.timestep);
        series.y.push_back(100.0 * point.energy_error);
        const double ratio = point.timestep / result.bed.front().timestep;
        square.x.push_back(1e6 * point.timestep);
        square.y.push_back(100.0 * result.bed.front().energy_error * ratio * ratio);
    }
    chart.series = {std::move(series), std::move(square)};
    chart.vertical_lines = {
        {.x = 1e6 * result.automatic_step, .text = "automatic step, factor 0.8"},
        {.x = 1e6 * verify::sticking_pair_limit(), .text = "limit of a sticking pair"}};
    return chart;
}

std::string stability_map_text(const StabilityMapResult& result) {
    const auto expected = std::count_if(result.map.begin(), result.map.end(), is_as_expected);
    std::string text = fmt::format(
        "{} of {} points of the map grow, or do not, as sqrt(1 + b^2) - b says.\n"
        "The shaken bed has an automatic step of {:.3g} s.\n\n   step      energy of the "
        "integrator "
        "over what friction and dashpots took\n",
        expected,
        result.map.size(),
        result.automatic_step);
    for (const verify::BedPoint& point : result.bed) {
        text += fmt::format("{:8.2g} s   {:.2g} %\n", point.timestep, 100.0 * point.energy_error);
    }
    return text;
}

void write_stability_map_folder(const StabilityMapResult& result,
                                const StudyOrigin& origin,
                                const std::filesystem::path& folder) {
    io::make_folder(folder);
    const render::ChartProvenance provenance{{"Software", "grainbench " + build_info().version},
                                             {"Source", origin.command}};
    render::write_chart(map_chart(result), folder / "stability-map", provenance);
    render::write_chart(bed_chart(result), folder / "shaken-bed", provenance);
}

}  // namespace grainbench::cli
