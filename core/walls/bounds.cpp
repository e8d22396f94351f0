#include "core/walls/bounds.hpp"

#include <numeric>
#include <utility>

namespace grainbench {

BoundsTree::BoundsTree(std::vector<Bounds> bounds)
    : bounds_(std::move(bounds)), order_(bounds_.size()) {
    std::iota(order_.begin(), order_.end(), Index{0});
    if (!bounds_.empty()) {
        // 4: a leaf is then about as dear to look at as the two nodes that would replace it.
        const std::size_t leaf_size = bounds_.size() <= plain_loop ? plain_loop : 4;
        build_node(0, static_cast<Index>(bounds_.size()), leaf_size);
    }
}

void BoundsTree::build_node(Index first, Index last, std::size_t leaf_size) {
    const std::size_t self = nodes_.size();
    nodes_.push_back({.first = first, .last = last});
    Bounds centres;
    const auto middle_of = [&](Index item) {
        return 0.5 * (bounds_[item].low + bounds_[item].high);
    };
    for (Index k = first; k < last; ++k) {
        nodes_[self].bounds.include(bounds_[order_[k]]);
        centres.include(middle_of(order_[k]));
    }
    if (last - first <= leaf_size) {
        return;
    }
    const Vec3 extent = centres.high - centres.low;
    double Vec3::*axis = extent.x >= extent.y ? &Vec3::x : &Vec3::y;
    if (extent.z > extent.*axis) {
        axis = &Vec3::z;
    }
    const Index median = first + (last - first) / 2;
    std::nth_element(order_.begin() + first,
                     order_.begin() + median,
                     order_.begin() + last,
                     [&](Index a, Index b) {
                         const double at_a = middle_of(a).*axis;
                         const double at_b = middle_of(b).*axis;
                         return at_a != at_b ? at_a < at_b : a < b;
                     });
    build_node(first, median, leaf_size);
    nodes_[self].right = static_cast<Index>(nodes_.size());
    build_node(median, last, leaf_size);
}

}  // namespace grainbench
