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

}  // namespace grainbench::statistics
