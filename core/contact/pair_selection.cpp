#include "core/contact/pair_selection.hpp"

#include "core/contact/bits.hpp"

#include <algorithm>

namespace grainbench {

namespace {

/// Words of a part: enough work to be worth a thread.
constexpr std::size_t part_words = 128;

}  // namespace

void PairSelection::select(const PairList& from,
                           std::span<const std::uint64_t> bits,
                           const Kernels& kernels,
                           const Workers& workers) {
    parts_.resize((bits.size() + part_words - 1) / part_words);
    for (std::size_t p = 0; p < parts_.size(); ++p) {
        parts_[p].first_word = p * part_words;
        parts_[p].last_word = std::min((p + 1) * part_words, bits.size());
    }
    workers.for_each(parts_.size(), [&](std::size_t p) {
        Part& part = parts_[p];
        part.count = static_cast<Index>(
            kernels.count_bits(bits.data() + part.first_word, part.last_word - part.first_word));
    });
    list_.count = 0;
    for (Part& part : parts_) {
        part.first = list_.count;
        list_.count += part.count;
    }
    list_.pad();
    place_.resize(list_.count);
    workers.for_each(parts_.size(), [&](std::size_t p) {
        const Part& part = parts_[p];
        kernels.select_pairs({.bits = bits.data() + part.first_word,
                              .words = part.last_word - part.first_word,
                              .first = static_cast<Index>(64 * part.first_word),
                              .i = from.i.data(),
                              .j = from.j.data(),
                              .place = place_.data() + part.first,
                              .chosen_i = list_.i.data() + part.first,
                              .chosen_j = list_.j.data() + part.first});
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
