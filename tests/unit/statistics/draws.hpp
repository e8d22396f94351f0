/// Synthetic realisations whose true means are known.
#pragma once

#include "core/statistics/curves.hpp"

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace grainbench::statistics {

class Draws {
public:
    explicit Draws(std::uint64_t seed) : random_(seed) {}

    std::vector<double> sample(std::size_t count, double mean, double deviation) {
        std::vector<double> values(count);
        for (double& value : values) {
            value = mean + deviation * normal_(random_);
        }
        return values;
    }

    /// Curves of mean zero and deviation one at each point; neighbours are correlated by rho, as in
    /// histories, where one moment follows from the last.
    Curves curves(std::size_t count, std::size_t points, double rho) {
        Curves result;
        for (std::size_t n = 0; n < count; ++n) {
            std::vector<double> curve(points);
            double value = normal_(random_);
            for (double& y : curve) {
                y = value;
                value = rho * value + std::sqrt(1.0 - rho * rho) * normal_(random_);
            }
            result.push_back(std::move(curve));
        }
        return result;
    }

private:
    std::mt19937_64 random_;
    std::normal_distribution<double> normal_;
};

/// How often something holds.
template <class HoldsOnce>
double frequency(int times, HoldsOnce&& holds_once) {
    int held = 0;
    for (int k = 0; k < times; ++k) {
        held += holds_once() ? 1 : 0;
    }
    return static_cast<double>(held) / times;
}

/// How often the band over a difference of two sets of alike curves holds at all points at once.
inline double coverage_of_band(std::size_t realisations, double rho, int times) {
    Draws random(realisations);
    std::uint64_t seed = 0;
    return frequency(times, [&] {
        const Curves a = random.curves(realisations, 20, rho);
        const Curves b = random.curves(realisations, 20, rho);
        const CurveDifference difference =
            curve_difference(a, b, false, {.replicates = 199, .seed = ++seed});
        bool holds = true;
        for (std::size_t k = 0; k < difference.at.size(); ++k) {
            holds = holds && std::abs(difference.at[k].value) <= difference.reach[k];
        }
        return holds;
    });
}

}  // namespace grainbench::statistics
