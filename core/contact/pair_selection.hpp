/// Some of the pairs of a list, side by side, in its order.
#pragma once

#include "core/kernels/kernels.hpp"
#include "core/parallel/workers.hpp"
#include "core/search/candidates.hpp"

#include <span>

namespace grainbench {

class PairSelection {
public:
    /// Makes these the pairs of a list whose bits are set.
    void select(const PairList& from,
                std::span<const std::uint64_t> bits,
                const Kernels& kernels,
                const Workers& workers);

    const PairList& list() const { return list_; }

    /// First pair whose place in the whole list is not before `place`; the count if there is none.
    Index first_from(Index place) const;

    /// Flips the bits of some of these among the bits of the whole list.
    /// \param bits by pair of these
    void flip(std::span<const std::uint64_t> bits, std::span<std::uint64_t> by_place) const;

private:
    /// The pairs of some consecutive words of the bits by place.
    struct Part {
        std::size_t first_word, last_word;
        Index first = 0;  ///< pair of list_
        Index count = 0;
    };

    PairList list_;
    std::vector<Index> place_;  ///< of each of them in the whole list
    std::vector<Part> parts_;
};

}  // namespace grainbench
