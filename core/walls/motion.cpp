#include "core/walls/motion.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

namespace grainbench {

namespace {

/// Intervals of one period and of its first half, which the second half repeats backwards.
constexpr int intervals = 200;
constexpr int half_intervals = intervals / 2;

Vec3 direction_of(const Vec3& given, const std::string& member) {
    const double length = norm(given);
    if (!std::isfinite(length) || length == 0.0) {
        throw_bad_input({.what = "the " + member + " of a wall motion has no direction",
                         .where = "motion/" + member,
                         .likely_cause = "all three components are zero, or one is not finite",
                         .next_step = "give a vector of any length but 0, such as [0, 0, 1]"});
    }
    return (1.0 / length) * given;
}

void check_table(const TableMotion& table) {
    const bool usable = !table.times.empty() && table.times.size() == table.speeds.size() &&
                        table.times.front() == 0.0 &&
                        std::is_sorted(table.times.begin(), table.times.end()) &&
                        (!table.repeat || table.times.back() > 0.0);
    if (!usable) {
        throw_bad_input({.what = "the table of a wall motion cannot be read as speed over time",
                         .where = "motion/times",
                         .likely_cause =
                             "times do not ascend from 0, a repeated table ends at 0, or "
                             "times and speeds differ in number",
                         .next_step = "give one speed for each time, the first time being 0"});
    }
}

}  // namespace

std::vector<std::pair<double, double>> smoothed_square_table(double frequency, double amplitude) {
    // Steepness and midpoint of the logistic flank, in periods: those of the example.
    constexpr double steepness = 130.0;
    constexpr double midpoint = 0.055;
    const double period = 1.0 / frequency;
    // Fractions of integers: adding up the interval could miss or repeat a node, and miss the
    // period.
    const auto time = [&](int j) { return period * (static_cast<double>(j) / intervals); };

    std::vector<double> rising(half_intervals / 2, 0.0);
    for (std::size_t j = 1; j < rising.size(); ++j) {
        const double s = static_cast<double>(j) / intervals;
        rising[j] = amplitude / (1.0 + std::exp(-steepness * (s - midpoint)));
    }
    const auto first_half = [&](int j) {
        const int mirrored = half_intervals - 1 - j;
        return j < half_intervals ? rising[static_cast<std::size_t>(std::min(j, mirrored))] : 0.0;
    };

    std::vector<std::pair<double, double>> nodes;
    for (int j = 0; j <= half_intervals; ++j) {
        nodes.emplace_back(time(j), first_half(j));
    }
    for (int j = half_intervals; j >= 0; --j) {
        nodes.emplace_back(time(intervals - j), -first_half(j));
    }
    return nodes;
}

MotionEvaluator::MotionEvaluator(const WallMotion& motion, double start) : start_(start) {
    std::visit(Overloaded{[](const FixedMotion&) {},
                          [&](const ConstantMotion& m) {
                              kind_ = Kind::constant;
                              direction_ = m.velocity;
                          },
                          [&](const SinusoidMotion& m) {
                              kind_ = Kind::sinusoid;
                              direction_ = m.velocity;
                              frequency_ = m.frequency;
                              phase_ = m.phase;
                          },
                          [&](const RotationMotion& m) {
                              kind_ = Kind::rotation;
                              direction_ = m.rate * direction_of(m.axis, "axis");
                              centre_ = m.point;
                          },
                          [&](const TableMotion& m) {
                              check_table(m);
                              kind_ = Kind::table;
                              direction_ = direction_of(m.direction, "direction");
                              repeat_ = m.repeat;
                              times_ = m.times;
                              speeds_ = m.speeds;
                          },
                          [&](const SmoothedSquareMotion& m) {
                              kind_ = Kind::table;
                              direction_ = direction_of(m.direction, "direction");
                              repeat_ = true;
                              for (const auto& [time, speed] :
                                   smoothed_square_table(m.frequency, m.amplitude)) {
                                  times_.push_back(time);
                                  speeds_.push_back(speed);
                              }
                          }},
               motion);
}

WallVelocity MotionEvaluator::at(double t) const {
    switch (kind_) {
        case Kind::fixed:
            return {};
        case Kind::constant:
            return {.linear = direction_};
        case Kind::sinusoid:
            return {.linear = std::sin(2.0 * pi * frequency_ * (t - start_) + phase_) * direction_};
        case Kind::rotation:
            return {.angular = direction_};
        case Kind::table:
            return {.linear = table_speed(t) * direction_};
    }
    return {};
}

double MotionEvaluator::table_speed(double t) const {
    const double last = times_.back();
    double local = std::max(t - start_, 0.0);
    if (repeat_ && local > last) {
        // A period starts anew only once it is exceeded: local stays in (0, last].
        local = std::clamp(local - (std::ceil(local / last) - 1.0) * last, 0.0, last);
    }
    if (local >= last) {
        return speeds_.back();
    }
    const auto next = static_cast<std::size_t>(
        std::upper_bound(times_.begin(), times_.end(), local) - times_.begin());
    const double fraction = (local - times_[next - 1]) / (times_[next] - times_[next - 1]);
    return speeds_[next - 1] + fraction * (speeds_[next] - speeds_[next - 1]);
}

}  // namespace grainbench
