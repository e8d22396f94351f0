/// Candidate pairs from a grid of cells, in lexicographic order of (i, j), i < j.
#pragma once

#include "core/archive.hpp"
#include "core/state/aligned.hpp"
#include "core/state/particle_state.hpp"

#include <algorithm>
#include <vector>

namespace grainbench {

/// The particle that a row is, or is an image of; every row is its own where there are no images.
class RowOwners {
public:
    RowOwners() = default;

    explicit RowOwners(const ParticleState& particles)
        : particles_(particles.has_images() ? &particles : nullptr) {}

    Index operator()(Index row) const {
        return particles_ == nullptr ? row : particles_->owner(row);
    }

    bool are_trivial() const { return particles_ == nullptr; }

private:
    const ParticleState* particles_ = nullptr;
};

/// Pairs in two columns, readable up to the next multiple of 64 past `count` (the padding pairs
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

    /// First of the pairs, which ascend by i, whose i is not below `a`.
    Index first_of(Index a) const {
        return static_cast<Index>(std::lower_bound(i.begin(), i.begin() + count, a) - i.begin());
    }

    /// End of the pairs of `a`, which begin at `first` if there are any.
    Index end_of(Index a, Index first) const {
        while (first < count && i[first] == a) {
            ++first;
        }
        return first;
    }

    /// Leaves out the pairs for which goes(i, j).
    template <class Goes>
    void remove_if(const Goes& goes) {
        Index stay = 0;
        for (Index k = 0; k < count; ++k) {
            if (!goes(i[k], j[k])) {
                i[stay] = i[k];
                j[stay++] = j[k];
            }
        }
        i.resize(stay);
        j.resize(stay);
        count = stay;
        pad();
    }

    /// Call once after the last append, or where `count` has been set. What was behind it in a
    /// longer list may name particles that are gone.
    void pad() {
        const std::size_t padded = (static_cast<std::size_t>(count) + 63) / 64 * 64;
        for (Column<Index>* column : {&i, &j}) {
            if (column->capacity() < padded) {
                column->reserve(padded + padded / 16);  // and not twice as much
            }
            column->resize(count);
            column->resize(padded, 0);
        }
    }

    /// Takes over the columns of those names; every i must be below i_end, and every j below j_end,
    /// and pairs ascend by (i, owner of j).
    void load(const Archive& archive,
              const std::string& i_name,
              const std::string& j_name,
              std::size_t i_end,
              std::size_t j_end,
              const RowOwners& owner = {});

    /// One bit per pair fills so many words.
    std::size_t words() const { return i.size() / 64; }
};

/// Finds all pairs whose distance is at most scale * (R_i + R_j) + extra. The grid suits the
/// smallest particle; a pair is found by its larger particle, which looks as many cells around as
/// it needs, so size ratios cost little. Small work space is kept between calls.
class CandidateFinder {
public:
    void find(const ParticleState& particles,
              double scale,
              double extra,
              const Kernels& kernels,
              PairList& pairs);

private:
    void sort_into_cells(const ParticleState& particles, double edge);
    void order_pairs(Index row_count, std::size_t found, PairList& pairs);
    void release_work_space();

    CellGrid grid_{};
    std::vector<Index> cell_start_;
    std::vector<Index> next_;  ///< by cell or row, while counting
    std::vector<std::uint32_t> cell_of_;
    std::vector<Index> slot_;   ///< by place in the sorted order
    Column<double> centre_[3];  ///< [m] by place
    Column<double> radius_;     ///< [m] by place
    Column<Index> found_i_, found_j_;
};

}  // namespace grainbench
