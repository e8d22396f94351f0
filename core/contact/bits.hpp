/// Sets of places in a list, one bit each, 64 in a word.
#pragma once

#include "core/types.hpp"

#include <cstdint>
#include <span>

namespace grainbench {

/// Calls act(place) for each bit of a word, ascending.
/// \param first place of its lowest bit
template <class Act>
void for_each_bit(std::uint64_t word, std::size_t first, const Act& act) {
    for (; word != 0; word &= word - 1) {
        act(static_cast<Index>(first) + static_cast<Index>(__builtin_ctzll(word)));
    }
}

/// The same for a set.
template <class Act>
void for_each_bit(std::span<const std::uint64_t> words, const Act& act) {
    for (std::size_t w = 0; w < words.size(); ++w) {
        for_each_bit(words[w], 64 * w, act);
    }
}

/// The same for those of places [first, last).
template <class Act>
void for_each_bit(std::span<const std::uint64_t> words, Index first, Index last, const Act& act) {
    for (std::size_t w = first / 64; 64 * w < last; ++w) {
        const std::uint64_t from =
            64 * w < first ? ~std::uint64_t{0} << (first % 64) : ~std::uint64_t{0};
        const std::uint64_t to =
            last < 64 * (w + 1) ? ~(~std::uint64_t{0} << (last % 64)) : ~std::uint64_t{0};
        for_each_bit(words[w] & from & to, 64 * w, act);
    }
}

inline bool has_bit(std::span<const std::uint64_t> words, Index place) {
    return (words[place / 64] >> (place % 64) & 1) != 0;
}

}  // namespace grainbench
