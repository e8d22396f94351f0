/// Ranges and ticks of charts.
#include "render/chart_scale.hpp"

#include "tests/unit/io/temporary_folder.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace grainbench::render {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> labels_of(const std::vector<Tick>& ticks) {
    std::vector<std::string> labels;
    for (const Tick& tick : ticks) {
        labels.push_back(tick.label);
    }
    return labels;
}

AxisRange linear(double low, double high) {
    return {.scale = AxisScale::linear, .low = low, .high = high};
}

AxisRange logarithmic(double low, double high) {
    return {.scale = AxisScale::logarithmic, .low = std::log10(low), .high = std::log10(high)};
}

Chart chart_of(std::vector<double> y) {
    Chart chart;
    ChartSeries series;
    for (std::size_t k = 0; k < y.size(); ++k) {
        series.x.push_back(static_cast<double>(k));
    }
    series.y = std::move(y);
    chart.series.push_back(series);
    return chart;
}

TEST(ChartTicks, StandAtRoundNumbers) {
    EXPECT_THAT(labels_of(ticks_of(linear(0.0, 20.0), 5)), ElementsAre("0", "5", "10", "15", "20"));
    EXPECT_THAT(labels_of(ticks_of(linear(-0.31, 0.1), 4)),
                ElementsAre("-0.3", "-0.2", "-0.1", "0", "0.1"));
    EXPECT_THAT(labels_of(ticks_of(linear(0.0, 2.1e-5), 4)),
                ElementsAre("0", "5e-6", "1e-5", "1.5e-5", "2e-5"));
    EXPECT_THAT(labels_of(ticks_of(linear(1234400.0, 1235600.0), 3)),
                ElementsAre("1.2345e6", "1.235e6", "1.2355e6"));
    EXPECT_THAT(labels_of(ticks_of(linear(-2.1e6, 1.1e6), 3)),
                ElementsAre("-2e6", "-1e6", "0", "1e6"));
}

TEST(ChartTicks, OfALogarithmicAxisStandAtPowersOfTen) {
    EXPECT_THAT(labels_of(ticks_of(logarithmic(900.0, 1.1e7), 9)),
                ElementsAre("1e3", "1e4", "1e5", "1e6", "1e7"));
    EXPECT_THAT(labels_of(ticks_of(logarithmic(8.0, 120.0), 9)),
                ElementsAre("10", "20", "50", "100"));
    // Less than a decade: round numbers, at the places of their logarithms.
    const auto ticks = ticks_of(logarithmic(2.1, 2.9), 4);
    EXPECT_THAT(labels_of(ticks), ElementsAre("2.2", "2.4", "2.6", "2.8"));
    EXPECT_EQ(ticks.front().place, std::log10(ticks_of(linear(2.1, 2.9), 4).front().place));
}

TEST(ChartRange, HoldsAllNumbersAndPassesOverWhatIsNone) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    const ChartRanges ranges = ranges_of(chart_of({none, 2.0, -1.0, none}));
    EXPECT_LT(ranges.y.low, -1.0);
    EXPECT_GT(ranges.y.high, 2.0);
    EXPECT_EQ(ranges.x.low, 0.0);
    EXPECT_EQ(ranges.x.high, 3.0);
}

TEST(ChartRange, ShowsOneNumberInTheMiddle) {
    const ChartRanges ranges = ranges_of(chart_of({5.0, 5.0}));
    EXPECT_EQ(ranges.y.low + ranges.y.high, 10.0);
    EXPECT_LT(ranges.y.low, ranges.y.high);
}

TEST(ChartRange, OfBarsBeginsAtZero) {
    Chart chart = chart_of({3.0, 4.0});
    chart.categories = {"a", "b"};
    chart.series.front().kind = SeriesKind::bars;
    EXPECT_EQ(ranges_of(chart).y.low, 0.0);
}

TEST(ChartRange, RefusesWhatCannotBeShown) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT(error_of([&] { ranges_of(chart_of({none})); }), HasSubstr("no number to show"));
    Chart chart = chart_of({-1.0, 0.0});
    chart.y.scale = AxisScale::logarithmic;
    EXPECT_THAT(error_of([&] { ranges_of(chart); }), HasSubstr("above zero"));
    chart = chart_of({1.0});
    chart.y.low = 2.0;
    chart.y.high = 1.0;
    EXPECT_THAT(error_of([&] { ranges_of(chart); }), HasSubstr("from 2 to 1"));
}

}  // namespace
}  // namespace grainbench::render
