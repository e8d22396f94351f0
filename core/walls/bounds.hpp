/// Axis-aligned bounds of patches and a tree over them, so that looking for patches near a sphere
/// costs the logarithm of their number.
#pragma once

#include "core/types.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace grainbench {

struct Bounds {
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    Vec3 low{infinity, infinity, infinity};
    Vec3 high{-infinity, -infinity, -infinity};

    void include(const Vec3& p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }

    void include(const Bounds& other) {
        include(other.low);
        include(other.high);
    }

    double squared_distance(const Vec3& p) const {
        const auto outside = [](double x, double from, double to) {
            return std::max({from - x, x - to, 0.0});
        };
        const Vec3 gap{
            outside(p.x, low.x, high.x), outside(p.y, low.y, high.y), outside(p.z, low.z, high.z)};
        return dot(gap, gap);
    }
};

/// Binary tree of bounds, split at the median. Few items stay in one leaf, a plain loop.
class BoundsTree {
public:
    /// Below this number a loop over all bounds is as fast as a tree.
    static constexpr std::size_t plain_loop = 64;

    BoundsTree() = default;

    explicit BoundsTree(std::vector<Bounds> bounds);

    /// Calls act(item) for each item whose bounds, and those of all nodes above it, pass
    /// keep(bounds). keep may become stricter meanwhile. The order is fixed, ascending for few
    /// items.
    template <class Keep, class Act>
    void visit(const Keep& keep, const Act& act) const {
        if (nodes_.empty()) {
            return;
        }
        std::array<Index, 64> pending;  // medians halve: deeper than any count of Index can go
        std::size_t depth = 0;
        pending[depth++] = 0;
        while (depth > 0) {
            const Node& node = nodes_[pending[--depth]];
            if (!keep(node.bounds)) {
                continue;
            }
            if (node.right != 0) {
                pending[depth++] = node.right;
                pending[depth++] = static_cast<Index>(&node - nodes_.data()) + 1;
                continue;
            }
            for (Index k = node.first; k < node.last; ++k) {
                if (keep(bounds_[order_[k]])) {
                    act(order_[k]);
                }
            }
        }
    }

    /// Bounds of everything.
    const Bounds& all() const { return nodes_.front().bounds; }

private:
    /// Items order_[first, last); the left child follows its parent, right is 0 in leaves.
    struct Node {
        Bounds bounds{};
        Index first = 0;
        Index last = 0;
        Index right = 0;
    };

    void build_node(Index first, Index last, std::size_t leaf_size);

    std::vector<Bounds> bounds_;
    std::vector<Index> order_;
    std::vector<Node> nodes_;
};

}  // namespace grainbench
