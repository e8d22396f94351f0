#include "render/chart_scale.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace grainbench::render {
namespace {

/// Smallest interval that holds what was given to it.
class Extent {
public:
    void add(double place) {
        if (std::isfinite(place)) {
            low_ = std::min(low_, place);
            high_ = std::max(high_, place);
        }
    }

    bool empty() const { return low_ > high_; }

    double low() const { return low_; }

    double high() const { return high_; }

private:
    double low_ = std::numeric_limits<double>::infinity();
    double high_ = -std::numeric_limits<double>::infinity();
};

[[noreturn]] void refuse_axis(const ChartAxis& axis, const std::string& what) {
    throw_bad_input({.what = "cannot draw the axis '" + axis.label + "': " + what,
                     .where = "chart",
                     .likely_cause = axis.scale == AxisScale::logarithmic
                                         ? "a logarithmic axis holds numbers above zero only"
                                         : "the series are empty, or hold no finite number",
                     .next_step = axis.scale == AxisScale::logarithmic
                                      ? "use a linear axis, or leave the numbers <= 0 out"
                                      : "check the run or the column that the series are made of"});
}

/// \param margin empty space at either end, as a fraction of the extent
AxisRange range_of(const ChartAxis& axis, const Extent& extent, double margin) {
    AxisRange range{.scale = axis.scale, .low = 0.0, .high = 0.0};
    if (extent.empty() && !(axis.low && axis.high)) {
        refuse_axis(axis, "there is no number to show");
    }
    double spread = extent.high() - extent.low();
    if (!extent.empty() && spread <= 0.0) {
        // One value: show it in the middle of a range of its own size.
        spread = axis.scale == AxisScale::logarithmic ? 1.0 : std::abs(extent.low());
        spread = spread > 0.0 ? spread : 1.0;
        margin = std::max(margin, 0.1);
    }
    range.low = axis.low ? range.place(*axis.low) : extent.low() - margin * spread;
    range.high = axis.high ? range.place(*axis.high) : extent.high() + margin * spread;
    if (!std::isfinite(range.low) || !std::isfinite(range.high) || range.low >= range.high) {
        refuse_axis(axis,
                    fmt::format("its range would go from {:.6g} to {:.6g}",
                                axis.low.value_or(extent.low()),
                                axis.high.value_or(extent.high())));
    }
    return range;
}

std::vector<Tick> linear_ticks(const AxisRange& range, int wanted) {
    const double rough = (range.high - range.low) / std::max(wanted, 1);
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    const double mantissa = rough / power;
    const double step = power * (mantissa < 1.5   ? 1.0
                                 : mantissa < 3.5 ? 2.0
                                 : mantissa < 7.5 ? 5.0
                                                  : 10.0);
    std::vector<Tick> ticks;
    const double tolerance = 1e-9 * (range.high - range.low);  // a tick at the very end belongs
    for (double k = std::ceil((range.low - tolerance) / step); k * step <= range.high + tolerance;
         k += 1.0) {
        ticks.push_back({.place = k * step, .label = tick_text(k * step, step)});
    }
    return ticks;
}

std::vector<Tick> logarithmic_ticks(const AxisRange& range, int wanted) {
    const double decades = range.high - range.low;
    // Numbers at 1, or at 1, 2 and 5, of each decade; other decades are left out if there are many.
    const std::vector<double> mantissas =
        decades > 2.5 ? std::vector<double>{1.0} : std::vector<double>{1.0, 2.0, 5.0};
    const bool is_long = range.high > 4.0 || range.low < -3.0;  // 1e5 is easier to read than 100000
    const int every = std::max(1, static_cast<int>(std::ceil(decades / wanted)));
    std::vector<Tick> ticks;
    const auto last = static_cast<int>(std::ceil(range.high));
    for (auto decade = static_cast<int>(std::floor(range.low)); decade <= last; ++decade) {
        if (decade % every != 0) {
            continue;
        }
        for (const double mantissa : mantissas) {
            const double place = decade + std::log10(mantissa);
            const double value = mantissa * std::pow(10.0, decade);
            if (place >= range.low - 1e-9 && place <= range.high + 1e-9) {
                ticks.push_back({.place = place,
                                 .label = is_long ? fmt::format("{:.0f}e{}", mantissa, decade)
                                                  : tick_text(value, value)});
            }
        }
    }
    // Less than a step of 1, 2, 5: count evenly in the numbers themselves.
    if (ticks.size() < 2) {
        const AxisRange plain{.scale = AxisScale::linear,
                              .low = std::pow(10.0, range.low),
                              .high = std::pow(10.0, range.high)};
        ticks = linear_ticks(plain, wanted);
        for (Tick& tick : ticks) {
            tick.place = std::log10(tick.place);
        }
    }
    return ticks;
}

}  // namespace

double AxisRange::place(double value) const {
    if (scale == AxisScale::linear) {
        return value;
    }
    return value > 0.0 ? std::log10(value) : std::numeric_limits<double>::quiet_NaN();
}

ChartRanges ranges_of(const Chart& chart) {
    Extent across;
    Extent along;
    const AxisRange x{.scale = chart.x.scale, .low = 0.0, .high = 0.0};
    const AxisRange y{.scale = chart.y.scale, .low = 0.0, .high = 0.0};
    const auto add_all = [](Extent& extent, const AxisRange& axis, std::span<const double> values) {
        for (const double value : values) {
            extent.add(axis.place(value));
        }
    };
    bool has_bars = false;
    for (const ChartSeries& series : chart.series) {
        add_all(across, x, series.x);
        add_all(along, y, series.y);
        add_all(along, y, series.low);
        add_all(along, y, series.high);
        has_bars = has_bars || series.kind == SeriesKind::bars;
    }
    if (!chart.categories.empty()) {
        across.add(-0.6);
        across.add(static_cast<double>(chart.categories.size()) - 0.4);
    }
    if (has_bars && chart.y.scale == AxisScale::linear) {
        along.add(0.0);  // a bar whose foot is cut off lies
    }
    const bool is_log = chart.x.scale == AxisScale::logarithmic;
    ChartRanges ranges{.x = range_of(chart.x, across, is_log ? 0.05 : 0.0),
                       .y = range_of(chart.y, along, 0.06)};
    if (has_bars && along.low() == 0.0 && !chart.y.low) {
        ranges.y.low = 0.0;  // bars stand on the axis
    }
    return ranges;
}

std::vector<Tick> ticks_of(const AxisRange& range, int wanted) {
    return range.scale == AxisScale::linear ? linear_ticks(range, wanted)
                                            : logarithmic_ticks(range, wanted);
}

std::vector<Tick> ticks_of(const std::vector<std::string>& categories) {
    std::vector<Tick> ticks;
    for (std::size_t k = 0; k < categories.size(); ++k) {
        ticks.push_back({.place = static_cast<double>(k), .label = categories[k]});
    }
    return ticks;
}

std::string tick_text(double value, double step) {
    if (value == 0.0 || std::abs(value) < 1e-9 * step) {
        return "0";
    }
    const double largest = std::max(std::abs(value), std::abs(step));
    if (largest >= 1e5 || largest < 1e-3) {
        const auto exponent_of = [](double x) {
            return static_cast<int>(std::floor(std::log10(std::abs(x)) + 1e-9));
        };
        const int exponent = exponent_of(value);
        std::string mantissa = fmt::format(
            "{:.{}f}", value / std::pow(10.0, exponent), std::max(0, exponent - exponent_of(step)));
        if (mantissa.find('.') != std::string::npos) {
            mantissa.erase(mantissa.find_last_not_of("0.") + 1);
        }
        return fmt::format("{}e{}", mantissa, exponent);
    }
    const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
    return fmt::format("{:.{}f}", value, decimals);
}

}  // namespace grainbench::render
