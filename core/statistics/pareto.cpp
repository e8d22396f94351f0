#include "core/statistics/pareto.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace grainbench::statistics {

std::vector<std::size_t> pareto_front(std::span<const CostAndError> points) {
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
        return points[i].cost != points[j].cost ? points[i].cost < points[j].cost
                                                : points[i].error < points[j].error;
    });
    std::vector<std::size_t> front;
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t k : order) {
        if (points[k].error < least) {
            least = points[k].error;
            front.push_back(k);
        }
    }
    return front;
}

}  // namespace grainbench::statistics
