/// Means and differences of means of a few realisations, with what is needed for their intervals.
///
/// Model    mean of a sample: x, s / sqrt(n), n - 1 degrees of freedom                       (1)
///          difference of two:  x_a - x_b, sqrt(v_a + v_b) with v = s^2 / n,
///                              nu = (v_a + v_b)^2 / (v_a^2 / (n_a - 1) + v_b^2 / (n_b - 1)) (2)
/// Source   (1) Student, Biometrika 6, 1908. (2) Welch, Biometrika 34, 1947, with the degrees of
///          freedom of Satterthwaite, Biometrics Bulletin 2, 1946.
/// Limits   realisations are independent and near enough to normal; coverage is measured in
///          tests/unit/statistics. Welch's interval is kept where pairs share a packing: where
///          that makes them alike, the interval is wider than it had to be, never narrower.
#pragma once

#include <cstddef>
#include <limits>
#include <span>

namespace grainbench::statistics {

/// Moments of a sample.
struct Sample {
    std::size_t count = 0;
    double mean = 0.0;
    double deviation = 0.0;  ///< standard deviation, n - 1 in the denominator; 0 below two values
};

Sample sample_of(std::span<const double> values);

/// A number that was estimated.
struct Estimate {
    double value = 0.0;
    double standard_error = std::numeric_limits<double>::infinity();  ///< none below two values
    double degrees_of_freedom = 1.0;
};

struct Interval {
    double low = 0.0;
    double high = 0.0;

    bool contains(double x) const { return low <= x && x <= high; }
};

/// (1)
Estimate mean_of(const Sample& sample);

/// Of a over b, (2).
Estimate difference_of(const Sample& a, const Sample& b);

/// Of a over b where a[k] and b[k] belong together: (1) of their differences. Spans of one length.
Estimate paired_difference_of(std::span<const double> a, std::span<const double> b);

/// Two-sided interval that covers the true value with this probability.
Interval interval_of(const Estimate& estimate, double confidence);

}  // namespace grainbench::statistics
