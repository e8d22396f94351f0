#include "cli/study/charts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace grainbench::cli {
namespace {

using render::Chart;
using render::ChartSeries;
using render::SeriesKind;

/// Ends of the 95 % interval of a mean, in the unit shown; the mean itself without one.
statistics::Interval shown_interval(const statistics::Estimate& mean, double scale) {
    if (!std::isfinite(mean.standard_error)) {
        return {scale * mean.value, scale * mean.value};
    }
    const statistics::Interval interval = statistics::interval_of(mean, 0.95);
    return {scale * interval.low, scale * interval.high};
}

ChartSeries mean_series(const VariantResult& variant, const StudyResult& result, bool with_ends) {
    ChartSeries series{.name = variant.name};
    series.x = result.x;
    for (const statistics::Estimate& mean : variant.mean) {
        const statistics::Interval ends = shown_interval(mean, result.quantity.scale);
        series.y.push_back(result.quantity.scale * mean.value);
        if (with_ends) {
            series.low.push_back(ends.low);
            series.high.push_back(ends.high);
        }
    }
    return series;
}

Chart number_chart(const StudyResult& result) {
    Chart chart;
    chart.y = {.label = result.quantity.name, .unit = result.quantity.unit};
    ChartSeries bars{.kind = SeriesKind::bars};
    for (const VariantResult& variant : result.variants) {
        if (variant.mean.empty()) {
            continue;
        }
        chart.categories.push_back(variant.name);
        const ChartSeries one = mean_series(variant, result, true);
        bars.y.push_back(one.y.front());
        bars.low.push_back(one.low.front());
        bars.high.push_back(one.high.front());
    }
    chart.series.push_back(std::move(bars));
    return chart;
}

Chart curve_chart(const StudyResult& result) {
    Chart chart;
    chart.x = {.label = result.quantity.x_name, .unit = result.quantity.x_unit};
    chart.y = {.label = result.quantity.name, .unit = result.quantity.unit};
    for (std::size_t k = 0; k < result.variants.size(); ++k) {
        const VariantResult& variant = result.variants[k];
        if (variant.mean.empty()) {
            continue;
        }
        const bool is_reference = result.is_reference(variant);
        ChartSeries series = mean_series(variant, result, is_reference);
        series.kind = is_reference ? SeriesKind::band : SeriesKind::line;
        series.name += is_reference ? " (95 % band)" : "";
        series.look = k;
        chart.series.push_back(std::move(series));
    }
    return chart;
}

/// Interval of an absolute value.
statistics::Interval folded(const statistics::Interval& interval) {
    if (interval.low > 0.0 || interval.high < 0.0) {
        return {std::min(std::abs(interval.low), std::abs(interval.high)),
                std::max(std::abs(interval.low), std::abs(interval.high))};
    }
    return {0.0, std::max(-interval.low, interval.high)};
}

double shown_error(const StudyResult& result, const VariantResult& variant) {
    return result.is_reference(variant) ? 0.0
                                        : result.quantity.scale * std::abs(variant.largest().value);
}

}  // namespace

Chart overlay_chart(const StudyResult& result) {
    Chart chart = result.quantity.x_name.empty() ? number_chart(result) : curve_chart(result);
    chart.title = result.plan.study.title;
    return chart;
}

Chart cost_chart(const StudyResult& result) {
    Chart chart;
    chart.title = result.plan.study.title;
    chart.x = {.label = "speed-up over '" + result.reference().name + "'",
               .scale = render::AxisScale::logarithmic};
    chart.y = {.label = "largest deviation of the " + result.quantity.name,
               .unit = result.quantity.unit,
               .low = 0.0};
    double slowest = std::numeric_limits<double>::infinity();
    double fastest = 0.0;
    ChartSeries points{.name = "variant, 95 % interval", .kind = SeriesKind::points};
    for (const VariantResult& variant : result.variants) {
        if (variant.unstable || variant.mean.empty()) {
            continue;
        }
        const double y = shown_error(result, variant);
        const statistics::Interval ends =
            result.is_reference(variant)
                ? statistics::Interval{0.0, 0.0}
                : folded(shown_interval(variant.largest(), result.quantity.scale));
        points.x.push_back(variant.cost.speed_up);
        points.y.push_back(y);
        points.low.push_back(ends.low);
        points.high.push_back(ends.high);
        // A little to the right, so that the text leaves the marker free.
        chart.texts.push_back({.x = 1.02 * variant.cost.speed_up, .y = y, .text = variant.name});
        slowest = std::min(slowest, variant.cost.speed_up);
        fastest = std::max(fastest, variant.cost.speed_up);
    }
    ChartSeries front{.name = "Pareto front", .kind = SeriesKind::points, .look = 1};
    for (const std::size_t k : result.pareto) {
        front.x.push_back(result.variants[k].cost.speed_up);
        front.y.push_back(shown_error(result, result.variants[k]));
    }
    const double margin = result.quantity.scale * result.plan.study.margin;
    ChartSeries line{.name = "margin", .x = {slowest, fastest}, .y = {margin, margin}, .look = 2};
    chart.series = {std::move(points), std::move(front), std::move(line)};
    chart.x.low = 0.9 * slowest;
    chart.x.high = fastest * std::pow(fastest / slowest, 0.25) * 1.05;  // room for names
    return chart;
}

Chart growth_chart(const StudyResult& result) {
    Chart chart;
    chart.title = result.plan.study.title;
    const auto most = static_cast<double>(result.plan.study.realisations);
    chart.x = {.label = "realisations", .low = 0.0, .high = 1.05 * most};
    chart.y = {.label = "half width of the 95 % interval of the deviation",
               .unit = result.quantity.unit,
               .low = 0.0};
    for (std::size_t k = 0; k < result.variants.size(); ++k) {
        ChartSeries series{
            .name = result.variants[k].name, .kind = render::SeriesKind::points, .look = k};
        for (const GrowthStep& step : result.variants[k].growth) {
            series.x.push_back(static_cast<double>(step.realisations));
            series.y.push_back(result.quantity.scale * step.half_width);
        }
        if (!series.x.empty()) {
            chart.series.push_back(std::move(series));
        }
    }
    return chart;
}

}  // namespace grainbench::cli
