#include "core/statistics/estimate.hpp"

#include "core/statistics/student.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace grainbench::statistics {

Sample sample_of(std::span<const double> values) {
    Sample sample;
    sample.count = values.size();
    if (values.empty()) {
        return sample;
    }
    const auto n = static_cast<double>(values.size());
    for (const double value : values) {
        sample.mean += value / n;
    }
    double squares = 0.0;
    for (const double value : values) {
        squares += (value - sample.mean) * (value - sample.mean);
    }
    sample.deviation = values.size() > 1 ? std::sqrt(squares / (n - 1.0)) : 0.0;
    return sample;
}

Estimate mean_of(const Sample& sample) {
    Estimate estimate{.value = sample.mean};
    if (sample.count > 1) {
        const auto n = static_cast<double>(sample.count);
        estimate.standard_error = sample.deviation / std::sqrt(n);
        estimate.degrees_of_freedom = n - 1.0;  // (1)
    }
    return estimate;
}

Estimate difference_of(const Sample& a, const Sample& b) {
    Estimate estimate{.value = a.mean - b.mean};
    if (a.count > 1 && b.count > 1) {
        const auto n_a = static_cast<double>(a.count);
        const auto n_b = static_cast<double>(b.count);
        const double v_a = a.deviation * a.deviation / n_a;
        const double v_b = b.deviation * b.deviation / n_b;
        const double denominator = v_a * v_a / (n_a - 1.0) + v_b * v_b / (n_b - 1.0);
        estimate.standard_error = std::sqrt(v_a + v_b);
        estimate.degrees_of_freedom =
            denominator > 0.0 ? (v_a + v_b) * (v_a + v_b) / denominator : n_a + n_b - 2.0;  // (2)
    }
    return estimate;
}

Estimate paired_difference_of(std::span<const double> a, std::span<const double> b) {
    std::vector<double> differences;
    for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) {
        differences.push_back(a[k] - b[k]);
    }
    return mean_of(sample_of(differences));
}

Interval interval_of(const Estimate& estimate, double confidence) {
    const double reach =
        std::isfinite(estimate.standard_error)
            ? student_quantile(0.5 + 0.5 * confidence, estimate.degrees_of_freedom) *
                  estimate.standard_error
            : estimate.standard_error;
    return {estimate.value - reach, estimate.value + reach};
}

}  // namespace grainbench::statistics
