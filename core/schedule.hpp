/// When output is due: intervals that count from the start of a stage and never drift.
#pragma once

#include "core/archive.hpp"
#include "core/scene.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>

namespace grainbench {

/// Largest n, at least `first`, for which origin + n * interval <= t. Where steps are so much
/// longer than the interval that counting is hopeless, `first`: due once in each step.
inline std::uint64_t last_due(double t, double origin, double interval, std::uint64_t first) {
    constexpr double hopeless = 1e15;
    const double guess = (t - origin) / interval;
    if (!(guess < hopeless)) {
        return first;
    }
    // One less, for rounding; then as the definition says.
    std::uint64_t n = std::max(first, static_cast<std::uint64_t>(std::max(guess - 1.0, 0.0)));
    while (t >= origin + static_cast<double>(n + 1) * interval) {
        ++n;
    }
    return n;
}

/// Fires at origin + n * interval, n = 1, 2, ...; at most once per call.
class IntervalTimer {
public:
    void begin(double origin, std::optional<double> interval) {
        origin_ = origin;
        interval_ = interval.value_or(0.0);
        fired_ = 0;
    }

    /// Whether is_due() would say so.
    bool would_fire(double t) const {
        return interval_ > 0.0 && t >= origin_ + static_cast<double>(fired_ + 1) * interval_;
    }

    bool is_due(double t) {
        if (!would_fire(t)) {
            return false;
        }
        fired_ = last_due(t, origin_, interval_, fired_ + 1);
        return true;
    }

    void save(Archive& archive, const std::string& name) const {
        archive.put(name + "/times", std::vector<double>{origin_, interval_});
        archive.put(name + "/fired", fired_);
    }

    /// Call after begin() of the same stage.
    void load(const Archive& archive, const std::string& name) {
        const std::vector<double> expected{origin_, interval_};
        Archive::require(archive.get<double>(name + "/times") == expected, name + "/times");
        fired_ = archive.count(name + "/fired");
    }

private:
    double origin_ = 0.0;
    double interval_ = 0.0;
    std::uint64_t fired_ = 0;
};

/// All timers of a run.
class Schedule {
public:
    /// Starts the intervals of a stage anew at time t.
    void begin(const Output& output, double t) {
        frame.begin(t, output.frame_interval);
        history.begin(t, output.history_interval);
        trace.begin(t, output.trace_interval);
        field.begin(t, output.field_interval);
        checkpoint.begin(t, output.checkpoint_interval);
        fields_have_own_interval_ = output.field_interval.has_value();
        history_cycles_ = output.history_cycles.value_or(0);
    }

    bool history_is_due(double t, std::uint64_t cycle) {
        const bool by_time = history.is_due(t);
        return by_time ||
               (history_cycles_ > 0 && cycle % static_cast<std::uint64_t>(history_cycles_) == 0);
    }

    /// Asked before the timer of the frames, which they go with, counts.
    bool fields_are_due(double t) const {
        return (fields_have_own_interval_ ? field : frame).would_fire(t);
    }

    void save(Archive& archive) const {
        frame.save(archive, "schedule/frame");
        history.save(archive, "schedule/history");
        trace.save(archive, "schedule/trace");
        if (fields_have_own_interval_) {
            field.save(archive, "schedule/field");
        }
        checkpoint.save(archive, "schedule/checkpoint");
    }

    void load(const Archive& archive) {
        frame.load(archive, "schedule/frame");
        history.load(archive, "schedule/history");
        trace.load(archive, "schedule/trace");
        if (fields_have_own_interval_) {
            field.load(archive, "schedule/field");
        }
        checkpoint.load(archive, "schedule/checkpoint");
    }

    IntervalTimer frame;
    IntervalTimer history;
    IntervalTimer trace;
    IntervalTimer field;
    IntervalTimer checkpoint;

private:
    std::int64_t history_cycles_ = 0;
    bool fields_have_own_interval_ = false;
};

}  // namespace grainbench
