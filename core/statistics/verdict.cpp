#include "core/statistics/verdict.hpp"

#include "core/statistics/student.hpp"

#include <cmath>

namespace grainbench::statistics {
namespace {

constexpr double power = 0.8;

}  // namespace

std::string_view name_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::same:
            return "same";
        case Verdict::different:
            return "different";
        case Verdict::undecided:
            return "undecided";
    }
    return "";
}

Verdict verdict_of(const Estimate& difference, double margin) {
    if (!std::isfinite(difference.standard_error)) {
        return Verdict::undecided;
    }
    const Interval narrow = interval_of(difference, 1.0 - 2.0 * verdict_alpha);
    if (narrow.low > -margin && narrow.high < margin) {
        return Verdict::same;  // (1)
    }
    const Interval wide = interval_of(difference, 1.0 - verdict_alpha);
    if (wide.low > margin || wide.high < -margin) {
        return Verdict::different;  // (2)
    }
    return Verdict::undecided;
}

std::optional<std::size_t> realisations_to_decide(double difference,
                                                  double spread,
                                                  double margin,
                                                  std::size_t comparisons) {
    const double room = std::abs(std::abs(difference) - margin);
    const bool is_within = std::abs(difference) < margin;
    // Chow, Shao and Wang 3.2.4: both tests may fail, so each gets half of the missing power.
    const double p_test = is_within ? 1.0 - verdict_alpha
                                    : 0.5 + 0.5 * std::pow(1.0 - verdict_alpha,
                                                           1.0 / static_cast<double>(comparisons));
    const double p_power = is_within ? 0.5 + 0.5 * power : power;
    const auto decides = [&](std::size_t n) {
        const double dof = 2.0 * (static_cast<double>(n) - 1.0);
        const double reach =
            (student_quantile(p_test, dof) + student_quantile(p_power, dof)) * spread;
        return reach < room * std::sqrt(static_cast<double>(n));
    };
    if (!(room > 0.0) || !decides(most_realisations)) {
        return std::nullopt;
    }
    std::size_t low = 1;  // does not decide
    std::size_t high = most_realisations;
    while (high - low > 1) {
        const std::size_t middle = low + (high - low) / 2;
        (decides(middle) ? high : low) = middle;
    }
    return high;
}

}  // namespace grainbench::statistics
