/// Candidate pairs from a grid of cells, in lexicographic order of (i, j), i < j.
#pragma once

#include "core/state/aligned.hpp"
#include "core/state/particle_state.hpp"

#include <vector>

namespace grainbench {

/// Pairs in two columns, readable up to the next multiple of 8 past `count` (the padding pairs
/// particle 0 with itself and is never used).
struct PairList {
    Column<Index> i;
    Column<Index> j;
    Index count = 0;

    void clear() {
        i.clear();
        j.clear();
        count = 0;
    }

    void append(Index a, Index b) {
        i.push_back(a);
        j.push_back(b);
        ++count;
    }

    /// Call once after the last append.
    void pad() {
        i.resize((count + 7) / 8 * 8 + 8, 0);
        j.resize(i.size(), 0);
    }
};

/// Finds all pairs whose distance is at most scale * (R_i + R_j) + extra. The grid suits the
/// smallest particle; a pair is found by its larger particle, which looks as many cells around as
/// it needs, so size ratios cost little. Work space is kept between calls.
class CandidateFinder {
public:
    void find(const ParticleState& particles, double scale, double extra, PairList& pairs);

private:
    struct Grid {
        Vec3 low{};
        double inverse_edge = 1.0;
        std::int64_t cells[3] = {1, 1, 1};

        std::int64_t coordinate(double x, int axis) const;
    };

    void sort_into_cells(const ParticleState& particles, double edge);
    void find_around(Index n, double scale, double extra);
    void order_pairs(Index particle_count, PairList& pairs);

    Grid grid_;
    std::vector<Index> cell_start_;
    std::vector<std::uint32_t> cell_of_;
    std::vector<Index> slot_;  ///< by place in the sorted order
    Column<double> packet_;    ///< positions in the sorted order
    std::vector<std::pair<Index, Index>> found_;
    std::vector<Index> row_start_;
};

}  // namespace grainbench
