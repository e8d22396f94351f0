#include "render/chart.hpp"

#include "core/error.hpp"

#include "io/atomic_file.hpp"
#include "io/text.hpp"
#include "io/vtk/session.hpp"

#include "render/chart_view.hpp"
#include "render/image.hpp"
#include "render/offscreen.hpp"

#include <fmt/format.h>

namespace grainbench::render {
namespace {

[[noreturn]] void refuse_series(const ChartSeries& series, const std::string& what) {
    throw_bad_input({.what = "cannot draw the series '" + series.name + "': " + what,
                     .where = "chart",
                     .likely_cause = "its columns come from tables that do not belong together",
                     .next_step = "give as many numbers for each column"});
}

void check(const Chart& chart) {
    for (const ChartSeries& series : chart.series) {
        const std::size_t points = series.y.size();
        if (series.kind == SeriesKind::bars) {
            if (points > chart.categories.size()) {
                refuse_series(
                    series,
                    fmt::format("{} bars for {} categories", points, chart.categories.size()));
            }
        } else if (series.x.size() != points) {
            refuse_series(
                series, fmt::format("{} numbers along x and {} along y", series.x.size(), points));
        }
        const bool has_spread = !series.low.empty() || !series.high.empty();
        if (has_spread || series.kind == SeriesKind::band) {
            if (series.low.size() != points || series.high.size() != points) {
                refuse_series(series,
                              fmt::format("{} lower and {} upper ends for {} points",
                                          series.low.size(),
                                          series.high.size(),
                                          points));
            }
        }
    }
}

std::string column_name(const ChartAxis& axis, const char* otherwise) {
    const std::string name = axis.label.empty() ? otherwise : axis.label;
    const bool has_unit = !axis.unit.empty() && axis.unit != "1";
    return io::csv_field(has_unit ? name + " [" + axis.unit + "]" : name);
}

}  // namespace

std::string chart_csv(const Chart& chart) {
    std::string text = fmt::format(
        "series,{},{},low,high\n", column_name(chart.x, "x"), column_name(chart.y, "y"));
    for (const ChartSeries& series : chart.series) {
        const std::string name = io::csv_field(series.name);
        for (std::size_t k = 0; k < series.y.size(); ++k) {
            const bool is_bar = series.kind == SeriesKind::bars;
            text +=
                fmt::format("{},{},{},{},{}\n",
                            name,
                            is_bar ? io::csv_field(chart.categories[k]) : io::to_text(series.x[k]),
                            io::to_text(series.y[k]),
                            series.low.empty() ? "" : io::to_text(series.low[k]),
                            series.high.empty() ? "" : io::to_text(series.high[k]));
        }
    }
    return text;
}

void write_chart(const Chart& chart,
                 const std::filesystem::path& stem,
                 const ChartProvenance& provenance) {
    check(chart);
    const auto with_extension = [&](const char* extension) {
        std::filesystem::path path = stem;
        path += extension;
        return path;
    };
    std::string description;
    for (const auto& [key, value] : provenance) {
        description += fmt::format("{}{}: {}", description.empty() ? "" : "; ", key, value);
    }
    Image image;
    std::string svg;
    {
        const io::VtkSession session;
        Offscreen offscreen;
        ChartView view(chart, offscreen);
        image = view.draw();
        svg = view.svg(with_extension(".svg.tmp"), description);
        if (!session.error().empty()) {
            throw std::runtime_error("VTK cannot draw a chart: " + session.error());
        }
    }
    write_png(with_extension(".png"), image, provenance);
    io::write_file(with_extension(".svg"), svg);
    io::write_file(with_extension(".csv"), chart_csv(chart));
}

}  // namespace grainbench::render
