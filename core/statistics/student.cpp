#include "core/statistics/student.hpp"

#include <cmath>
#include <limits>

namespace grainbench::statistics {
namespace {

constexpr double pi = 3.14159265358979323846;

/// The continued fraction of I_x(a, b); converges fast for x < (a + 1) / (a + b + 2).
double beta_fraction(double a, double b, double x) {
    constexpr double tiny = 1e-300;
    constexpr int most_terms = 10'000;  // some tens suffice below a of 1e6
    const auto away_from_zero = [](double v) { return std::abs(v) < tiny ? tiny : v; };
    double c = 1.0;
    double d = 1.0 / away_from_zero(1.0 - (a + b) * x / (a + 1.0));
    double fraction = d;
    for (int m = 1; m <= most_terms; ++m) {
        const double k = 2.0 * m;
        const double even = m * (b - m) * x / ((a + k - 1.0) * (a + k));
        d = 1.0 / away_from_zero(1.0 + even * d);
        c = away_from_zero(1.0 + even / c);
        fraction *= d * c;
        const double odd = -(a + m) * (a + b + m) * x / ((a + k) * (a + k + 1.0));
        d = 1.0 / away_from_zero(1.0 + odd * d);
        c = away_from_zero(1.0 + odd / c);
        fraction *= d * c;
        if (std::abs(d * c - 1.0) < 4.0 * std::numeric_limits<double>::epsilon()) {
            break;
        }
    }
    return fraction;  // (2)
}

double incomplete_beta(double a, double b, double x) {
    if (x <= 0.0 || x >= 1.0) {
        return x <= 0.0 ? 0.0 : 1.0;
    }
    const double front = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) +
                                  a * std::log(x) + b * std::log1p(-x));
    return x < (a + 1.0) / (a + b + 2.0) ? front * beta_fraction(a, b, x) / a
                                         : 1.0 - front * beta_fraction(b, a, 1.0 - x) / b;
}

}  // namespace

double student_cdf(double t, double degrees_of_freedom) {
    const double x = degrees_of_freedom / (degrees_of_freedom + t * t);
    const double tail = 0.5 * incomplete_beta(0.5 * degrees_of_freedom, 0.5, x);
    return t < 0.0 ? tail : 1.0 - tail;  // (1)
}

double student_quantile(double p, double degrees_of_freedom) {
    if (p < 0.5) {
        return -student_quantile(1.0 - p, degrees_of_freedom);
    }
    double low = 0.0;
    double high = 1.0;
    while (student_cdf(high, degrees_of_freedom) < p && high < 1e300) {
        low = high;
        high *= 2.0;
    }
    // Newton's method, kept inside the bracket by halving where it would leave.
    const double nu = degrees_of_freedom;
    const double density_at_zero =
        std::exp(std::lgamma(0.5 * nu + 0.5) - std::lgamma(0.5 * nu)) / std::sqrt(nu * pi);
    double t = 0.5 * (low + high);
    for (int k = 0; k < 200 && high - low > 1e-14 * high; ++k) {
        const double excess = student_cdf(t, nu) - p;
        (excess < 0.0 ? low : high) = t;
        const double density =
            density_at_zero * std::exp(-0.5 * (nu + 1.0) * std::log1p(t * t / nu));
        const double next = t - excess / density;
        const bool stays = next > low && next < high;
        if (stays && std::abs(next - t) < 1e-14 * t) {
            return next;
        }
        t = stays ? next : 0.5 * (low + high);
    }
    return t;
}

}  // namespace grainbench::statistics
