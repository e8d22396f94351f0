/// Which settings are worth choosing when both cost and error should be small.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace grainbench::statistics {

struct CostAndError {
    double cost = 0.0;
    double error = 0.0;
};

/// Indices of the points that no other point beats in both (or beats in one and equals in the
/// other), by rising cost.
std::vector<std::size_t> pareto_front(std::span<const CostAndError> points);

}  // namespace grainbench::statistics
