#include "core/contact/pair_selection.hpp"

#include "core/contact/bits.hpp"

#include <algorithm>
#include <bit>

namespace grainbench {

namespace {

/// Words of a part: enough work to be worth a thread.
constexpr std::size_t part_words = 128;

}  // namespace

void PairSelection::select(const PairList& from,
                           std::span<const std::uint64_t> bits,
                           const Workers& workers) {
    parts_.resize((bits.size() + part_words - 1) / part_words);
    for (std::size_t p = 0; p < parts_.size(); ++p) {
        parts_[p].first_word = p * part_words;
        parts_[p].last_word = std::min((p + 1) * part_words, bits.size());
    }
    workers.for_each(parts_.size(), [&](std::size_t p) {
        Part& part = parts_[p];
        part.count = 0;
        for (std::size_t w = part.first_word; w < part.last_word; ++w) {
            part.count += static_cast<Index>(std::popcount(bits[w]));
        }
    });
    list_.count = 0;
    for (Part& part : parts_) {
        part.first = list_.count;
        list_.count += part.count;
    }
    list_.pad();
    place_.resize(list_.count);
    workers.for_each(parts_.size(), [&](std::size_t p) {
        Index k = parts_[p].first;
        const auto first = static_cast<Index>(64 * parts_[p].first_word);
        const auto last = static_cast<Index>(64 * parts_[p].last_word);
        for_each_bit(bits, first, last, [&](Index place) {
            place_[k] = place;
            list_.i[k] = from.i[place];
            list_.j[k++] = from.j[place];
        });
    });
}

Index PairSelection::first_from(Index place) const {
    return static_cast<Index>(std::lower_bound(place_.begin(), place_.end(), place) -
                              place_.begin());
}

void PairSelection::flip(std::span<const std::uint64_t> bits,
                         std::span<std::uint64_t> by_place) const {
    for_each_bit(
        bits, [&](Index k) { by_place[place_[k] / 64] ^= std::uint64_t{1} << (place_[k] % 64); });
}

}  // namespace grainbench
