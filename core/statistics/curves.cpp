#include "core/statistics/curves.hpp"

#include "core/statistics/student.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace grainbench::statistics {
namespace {

std::size_t points_of(const Curves& curves) {
    return curves.empty() ? 0 : curves.front().size();
}

/// Curves minus their mean.
Curves centred(const Curves& curves) {
    Curves result = curves;
    for (std::size_t k = 0; k < points_of(curves); ++k) {
        const double mean = sample_of(values_at(curves, k)).mean;
        for (std::vector<double>& curve : result) {
            curve[k] -= mean;
        }
    }
    return result;
}

/// Mean and variance of the mean at each point, of curves drawn with replacement.
struct Draw {
    std::vector<double> mean;
    std::vector<double> variance;

    void take(const Curves& curves, std::mt19937_64& random) {
        const std::size_t points = points_of(curves);
        const auto n = static_cast<double>(curves.size());
        mean.assign(points, 0.0);
        variance.assign(points, 0.0);
        std::uniform_int_distribution<std::size_t> any(0, curves.size() - 1);
        for (std::size_t draw = 0; draw < curves.size(); ++draw) {
            const std::vector<double>& curve = curves[any(random)];
            for (std::size_t k = 0; k < points; ++k) {
                mean[k] += curve[k];
                variance[k] += curve[k] * curve[k];
            }
        }
        for (std::size_t k = 0; k < points; ++k) {
            mean[k] /= n;
            variance[k] = std::max(0.0, variance[k] / n - mean[k] * mean[k]) / (n - 1.0);
        }
    }
};

/// Quantile of max_k |t_k| when there is no difference, (3).
double bootstrap_reach(const Curves& a, const Curves& b, const BootstrapOptions& options) {
    const Curves residual_a = centred(a);
    const Curves residual_b = centred(b);
    std::mt19937_64 random(options.seed);
    std::vector<double> largest;
    Draw draw_a;
    Draw draw_b;
    for (std::size_t r = 0; r < options.replicates; ++r) {
        draw_a.take(residual_a, random);
        draw_b.take(residual_b, random);
        double most = 0.0;
        for (std::size_t k = 0; k < draw_a.mean.size(); ++k) {
            const double error = std::sqrt(draw_a.variance[k] + draw_b.variance[k]);
            const double t = std::abs(draw_a.mean[k] - draw_b.mean[k]);
            most = std::max(most, error > 0.0 ? t / error : 0.0);
        }
        largest.push_back(most);
    }
    const auto rank = static_cast<std::ptrdiff_t>(
        std::ceil((1.0 - verdict_alpha) * static_cast<double>(options.replicates + 1)) - 1.0);
    std::nth_element(largest.begin(), largest.begin() + rank, largest.end());
    return largest[static_cast<std::size_t>(rank)];
}

/// Probability that each of so many intervals needs for all to hold.
double sidak_confidence(std::size_t intervals) {
    return std::pow(1.0 - verdict_alpha, 1.0 / static_cast<double>(intervals));
}

}  // namespace

std::vector<double> values_at(const Curves& curves, std::size_t k) {
    std::vector<double> values;
    for (const std::vector<double>& curve : curves) {
        values.push_back(curve.at(k));
    }
    return values;
}

std::vector<Estimate> mean_curve(const Curves& curves) {
    std::vector<Estimate> means;
    for (std::size_t k = 0; k < points_of(curves); ++k) {
        means.push_back(mean_of(sample_of(values_at(curves, k))));
    }
    return means;
}

CurveDifference curve_difference(const Curves& a,
                                 const Curves& b,
                                 bool paired,
                                 const BootstrapOptions& options) {
    CurveDifference difference;
    for (std::size_t k = 0; k < std::min(points_of(a), points_of(b)); ++k) {
        const std::vector<double> at_a = values_at(a, k);
        const std::vector<double> at_b = values_at(b, k);
        difference.at.push_back(paired ? paired_difference_of(at_a, at_b)
                                       : difference_of(sample_of(at_a), sample_of(at_b)));
        if (std::abs(difference.at.back().value) >
            std::abs(difference.at[difference.largest].value)) {
            difference.largest = k;
        }
    }
    difference.bootstrapped =
        !paired && std::min(a.size(), b.size()) >= fewest_for_bootstrap && !difference.at.empty();
    const double factor = difference.bootstrapped ? bootstrap_reach(a, b, options) : 0.0;
    for (const Estimate& at : difference.at) {
        const Interval alone = interval_of(at, sidak_confidence(difference.at.size()));
        difference.reach.push_back(difference.bootstrapped ? factor * at.standard_error
                                                           : 0.5 * (alone.high - alone.low));
    }
    return difference;
}

Verdict verdict_of(const CurveDifference& difference, double margin) {
    bool is_same = !difference.at.empty();
    bool is_different = false;
    for (std::size_t k = 0; k < difference.at.size(); ++k) {
        const Estimate& at = difference.at[k];
        if (!std::isfinite(at.standard_error)) {
            return Verdict::undecided;
        }
        const Interval narrow = interval_of(at, 1.0 - 2.0 * verdict_alpha);
        is_same = is_same && narrow.low > -margin && narrow.high < margin;                 // (1)
        is_different = is_different || std::abs(at.value) - difference.reach[k] > margin;  // (2)
    }
    if (is_same) {
        return Verdict::same;
    }
    return is_different ? Verdict::different : Verdict::undecided;
}

std::optional<std::size_t> realisations_to_decide(const CurveDifference& difference,
                                                  std::size_t realisations,
                                                  double margin) {
    const bool is_within =
        std::all_of(difference.at.begin(), difference.at.end(), [&](const Estimate& at) {
            return std::abs(at.value) < margin;
        });
    std::optional<std::size_t> needed;
    for (const Estimate& at : difference.at) {
        if (!std::isfinite(at.standard_error)) {
            return std::nullopt;
        }
        if (!is_within && std::abs(at.value) <= margin) {
            continue;
        }
        const double spread = at.standard_error * std::sqrt(static_cast<double>(realisations));
        const auto here = realisations_to_decide(at.value, spread, margin, difference.at.size());
        if (is_within && !here) {
            return std::nullopt;
        }
        if (here && (!needed || (is_within ? *here > *needed : *here < *needed))) {
            needed = here;
        }
    }
    return needed;
}

}  // namespace grainbench::statistics
