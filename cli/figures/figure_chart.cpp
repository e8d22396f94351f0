#include "cli/figures/figure_chart.hpp"

#include "core/error.hpp"
#include "core/statistics/estimate.hpp"
#include "core/walls/motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

namespace grainbench::cli {
namespace {

using render::Chart;
using render::ChartAxis;
using render::ChartSeries;
using render::SeriesKind;

double interpolate(const TimeSeries& series, double time) {
    const auto after = std::lower_bound(series.time.begin(), series.time.end(), time);
    const auto k = static_cast<std::size_t>(after - series.time.begin());
    if (k == 0 || series.time[k] == time) {
        return series.value[k];
    }
    const double t = (time - series.time[k - 1]) / (series.time[k] - series.time[k - 1]);
    return series.value[k - 1] + t * (series.value[k] - series.value[k - 1]);
}

void multiply(std::vector<double>& values, double factor) {
    for (double& value : values) {
        value *= factor;
    }
}

double quantity_of(const io::RealisationManifest& realisation, Quantity quantity) {
    const Summary& summary = realisation.summary;
    switch (quantity) {
        case Quantity::cycles:
            return static_cast<double>(realisation.cycles);
        case Quantity::mean_timestep:
            return summary.mean_timestep;
        case Quantity::largest_overlap_ratio:
            return summary.largest_overlap_ratio;
        case Quantity::entrainment_time:
            return summary.entrainment_time.value_or(std::numeric_limits<double>::quiet_NaN());
        case Quantity::cpu_seconds:
            return realisation.cpu_seconds;
        case Quantity::particle_steps_per_second:
            return realisation.particle_steps_per_second;
    }
    return std::numeric_limits<double>::quiet_NaN();
}

SeriesKind kind_of(Draw draw) {
    switch (draw) {
        case Draw::line:
            return SeriesKind::line;
        case Draw::points:
            return SeriesKind::points;
        case Draw::bars:
            break;
    }
    return SeriesKind::bars;
}

ChartAxis axis_of(const FigureAxis& axis) {
    return {.label = axis.label,
            .unit = axis.unit,
            .scale = axis.scale,
            .low = axis.low,
            .high = axis.high};
}

/// Adds the series of each curve to a chart.
class ChartBuilder {
public:
    ChartBuilder(const ChartFigure& figure, const ShownRuns& runs) : figure_(figure), runs_(runs) {
        chart_.title = figure.title;
        chart_.x = axis_of(figure.x);
        chart_.y = axis_of(figure.y);
        chart_.categories = figure.categories;
        for (const FigureLine& line : figure.vertical_lines) {
            chart_.vertical_lines.push_back(
                std::visit([&](const auto& each) { return line_of(each); }, line));
        }
    }

    Chart build() {
        for (const Curve& curve : figure_.curves) {
            std::visit([&](const auto& each) { add(each); }, curve);
        }
        return std::move(chart_);
    }

private:
    const ShownRun& run_of(const std::string& name) const { return runs_.at(name); }

    std::size_t look_of(const std::optional<std::int64_t>& asked, std::size_t otherwise) const {
        return asked ? static_cast<std::size_t>(*asked) : otherwise;
    }

    /// When a stage of a run begins and ends [s].
    std::pair<double, double> times_of(const std::string& run, std::int64_t stage) const {
        const std::vector<Stage>& stages = run_of(run).scene.stages;
        if (stage >= static_cast<std::int64_t>(stages.size())) {
            throw_bad_input({.what = fmt::format("the run '{}' has no stage {}", run, stage),
                             .where = where(),
                             .likely_cause = fmt::format("stages count from 0, and there are {}",
                                                         stages.size()),
                             .next_step = "compare with `stages` of the scene"});
        }
        double begin = 0.0;
        for (std::int64_t k = 0; k < stage; ++k) {
            begin += stages[static_cast<std::size_t>(k)].duration;
        }
        return {begin, begin + stages[static_cast<std::size_t>(stage)].duration};
    }

    render::VerticalLine line_of(const LineAt& line) const {
        return {.x = line.x, .text = line.text};
    }

    render::VerticalLine line_of(const LineAtStage& line) const {
        return {.x = figure_.x.factor * times_of(line.run, line.stage).first, .text = line.text};
    }

    std::string where() const { return "figure '" + figure_.name + "'"; }

    void add(const HistoryCurve& curve) {
        try {
            add_history(curve);
        } catch (const Error& error) {
            Diagnosis diagnosis = error.diagnosis();
            diagnosis.where = fmt::format("{}, history of the run '{}'", where(), curve.run);
            throw Error(error.kind(), std::move(diagnosis));
        }
    }

    void add_history(const HistoryCurve& curve) {
        const ShownRun& run = run_of(curve.run);
        double begin = 0.0;
        double end = std::numeric_limits<double>::infinity();
        if (curve.stage) {
            std::tie(begin, end) = times_of(curve.run, *curve.stage);
        }
        end = std::min(end, curve.until.value_or(end));
        std::vector<TimeSeries> series;
        for (const io::RealisationHistory& realisation : run.history.realisations) {
            series.push_back(time_series(
                realisation.history, curve.column, curve.period.value_or(0.0), begin, end));
        }
        const std::string name = curve.name.empty() ? run.label : curve.name;
        const std::size_t look = look_of(curve.look, run.look);
        if (curve.show == Show::realisations) {
            for (std::size_t k = 0; k < series.size(); ++k) {
                add_series({.name = series.size() == 1 ? name : fmt::format("{} {}", name, k + 1),
                            .kind = SeriesKind::line,
                            .x = series[k].time,
                            .y = series[k].value,
                            .is_heavy = curve.heavy,
                            .look = look + k});
            }
            return;
        }
        const MeanSeries mean = mean_series(series);
        ChartSeries result{.name = name,
                           .kind = curve.show == Show::band ? SeriesKind::band : SeriesKind::line,
                           .x = mean.time,
                           .y = mean.mean,
                           .is_heavy = curve.heavy,
                           .look = look};
        for (std::size_t k = 0; k < mean.time.size() && curve.show == Show::band; ++k) {
            result.low.push_back(mean.mean[k] - mean.deviation[k]);
            result.high.push_back(mean.mean[k] + mean.deviation[k]);
        }
        add_series(std::move(result));
    }

    void add(const WallVelocityCurve& curve) {
        const MotionEvaluator motion = motion_of(curve);
        constexpr int steps = 1000;  // the smoothed square wave has 202 corners in a period
        ChartSeries series{.name = curve.name,
                           .kind = SeriesKind::line,
                           .look = look_of(curve.look, chart_.series.size())};
        std::vector<Vec3> velocities;
        Vec3 largest{};
        for (int k = 0; k <= steps; ++k) {
            const double time = curve.duration * k / steps;
            const Vec3 velocity = motion.at(time).linear;
            series.x.push_back(time);
            velocities.push_back(velocity);
            largest = {std::max(largest.x, std::abs(velocity.x)),
                       std::max(largest.y, std::abs(velocity.y)),
                       std::max(largest.z, std::abs(velocity.z))};
        }
        for (const Vec3& velocity : velocities) {
            series.y.push_back(largest.z >= std::max(largest.x, largest.y) ? velocity.z
                               : largest.x >= largest.y                    ? velocity.x
                                                                           : velocity.y);
        }
        add_series(std::move(series));
    }

    /// Of the wall in that stage, or in the last one before it that moves the wall.
    MotionEvaluator motion_of(const WallVelocityCurve& curve) const {
        const Scene& scene = run_of(curve.run).scene;
        const auto last = std::min(scene.stages.size(), static_cast<std::size_t>(curve.stage) + 1);
        for (std::size_t stage = last; stage > 0; --stage) {
            for (const StageMotion& motion : scene.stages[stage - 1].motions) {
                if (motion.wall == curve.wall) {
                    return {motion.motion, 0.0};
                }
            }
        }
        throw_bad_input({.what = "no stage up to " + std::to_string(curve.stage) +
                                 " moves a wall '" + curve.wall + "'",
                         .where = where(),
                         .likely_cause = "the wall has another name in the scene of the run '" +
                                         curve.run + "'",
                         .next_step = "compare with `stages` of the scene"});
    }

    /// Over the realisations of a run that have such a number; not a number if none has.
    statistics::Sample sample_of(const std::string& run, Quantity quantity) const {
        std::vector<double> values;
        for (const io::RealisationManifest& each : run_of(run).manifest.realisations) {
            const double value = quantity_of(each, quantity);
            if (std::isfinite(value)) {
                values.push_back(value);
            }
        }
        statistics::Sample sample = statistics::sample_of(values);
        if (values.empty()) {
            sample.mean = std::numeric_limits<double>::quiet_NaN();
        }
        return sample;
    }

    void add(const SummaryCurve& curve) {
        ChartSeries series{.name = curve.name,
                           .kind = kind_of(curve.draw),
                           .x = curve.x,
                           .look = look_of(curve.look, chart_.series.size())};
        const double unit = curve.relative_to
                                ? 1.0 / sample_of(*curve.relative_to, curve.quantity).mean
                                : figure_.y.factor;
        bool has_spread = false;
        for (const std::string& name : curve.runs) {
            const statistics::Sample sample = sample_of(name, curve.quantity);
            series.y.push_back(unit * sample.mean);
            series.low.push_back(unit * (sample.mean - sample.deviation));
            series.high.push_back(unit * (sample.mean + sample.deviation));
            has_spread = has_spread || sample.count > 1;
        }
        if (!has_spread) {
            series.low.clear();
            series.high.clear();
        }
        if (curve.draw == Draw::bars && chart_.categories.empty()) {
            for (const std::string& name : curve.runs) {
                chart_.categories.push_back(run_of(name).label);
            }
        }
        chart_.series.push_back(std::move(series));
    }

    void add(const TableCurve& curve) {
        chart_.series.push_back({.name = curve.name,
                                 .kind = kind_of(curve.draw),
                                 .x = curve.x,
                                 .y = curve.y,
                                 .look = look_of(curve.look, chart_.series.size())});
    }

    /// Adds numbers of a run, which are in SI units.
    void add_series(ChartSeries series) {
        multiply(series.x, figure_.x.factor);
        for (std::vector<double>* values : {&series.y, &series.low, &series.high}) {
            multiply(*values, figure_.y.factor);
        }
        chart_.series.push_back(std::move(series));
    }

    const ChartFigure& figure_;
    const ShownRuns& runs_;
    Chart chart_;
};

}  // namespace

TimeSeries time_series(const io::HistoryTable& history,
                       const std::string& column,
                       double period,
                       double begin,
                       double end) {
    const std::vector<double>& time = history.column("time");
    const std::vector<double>& value = history.column(column);
    TimeSeries series;
    const auto add = [&](double t, double v) {
        if (std::isfinite(v) && t >= begin && t <= end) {
            series.time.push_back(t);
            series.value.push_back(v);
        }
    };
    if (period <= 0.0) {
        for (std::size_t k = 0; k < time.size(); ++k) {
            add(time[k], value[k]);
        }
        return series;
    }
    std::size_t row = 0;
    for (int interval = 1; row < time.size(); ++interval) {
        const double now = interval * period;
        // Half an interval later the average has been taken, and the next one not.
        while (row < time.size() && time[row] <= now + 0.5 * period) {
            ++row;
        }
        if (row > 0 && time[row - 1] > now + 0.25 * period) {
            add(now, value[row - 1]);
        }
    }
    return series;
}

MeanSeries mean_series(const std::vector<TimeSeries>& series) {
    MeanSeries result;
    double first = -std::numeric_limits<double>::infinity();
    double last = std::numeric_limits<double>::infinity();
    for (const TimeSeries& each : series) {
        if (each.time.empty()) {
            return result;
        }
        first = std::max(first, each.time.front());
        last = std::min(last, each.time.back());
    }
    for (std::size_t k = 0; k < (series.empty() ? 0 : series.front().time.size()); ++k) {
        const double time = series.front().time[k];
        if (time < first || time > last) {
            continue;
        }
        std::vector<double> values;
        values.reserve(series.size());
        for (const TimeSeries& each : series) {
            values.push_back(interpolate(each, time));
        }
        result.time.push_back(time);
        const statistics::Sample sample = statistics::sample_of(values);
        result.mean.push_back(sample.mean);
        result.deviation.push_back(sample.deviation);
    }
    return result;
}

render::Chart chart_of(const ChartFigure& figure, const ShownRuns& runs) {
    return ChartBuilder(figure, runs).build();
}

}  // namespace grainbench::cli
