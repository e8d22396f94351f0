/// Places in lists, picked out by bits and written side by side.
#pragma once

#include "core/simd/lanes.hpp"

namespace grainbench::GRAINBENCH_ISA {

#if HWY_TARGET <= HWY_AVX3
/// {first, first + 1, ...}
inline __m512i sixteen_from(Index first) {
    return _mm512_add_epi32(
        _mm512_set1_epi32(static_cast<int>(first)),
        _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15));
}

/// Writes the lanes whose bits are set side by side, and nothing past them.
inline void store_chosen(unsigned bits, __m512i lanes, void* to) {
    const unsigned first = (1U << static_cast<unsigned>(__builtin_popcount(bits))) - 1U;
    _mm512_mask_storeu_epi32(to,
                             static_cast<__mmask16>(first),
                             _mm512_maskz_compress_epi32(static_cast<__mmask16>(bits), lanes));
}
#endif

/// Appends the contact at place first + n to `found` for each bit n of a word, new where new_bits
/// says so; returns the new count. Where bits are few, a loop over them would end by a guess.
inline std::size_t append_contacts(std::uint64_t bits,
                                   std::uint64_t new_bits,
                                   Index first,
                                   TouchingContact* found,
                                   std::size_t count) {
#if HWY_TARGET <= HWY_AVX3
    static_assert(sizeof(TouchingContact) == 4 && std::is_trivially_copyable_v<TouchingContact>);
    const __m512i new_bit = _mm512_set1_epi32(static_cast<int>(TouchingContact::new_bit));
    for (Index k = 0; k < 64; k += 16) {
        const auto chosen = static_cast<unsigned>(bits >> k & 0xFFFF);
        const __m512i places = sixteen_from(first + k);
        store_chosen(
            chosen,
            _mm512_mask_or_epi32(places, static_cast<__mmask16>(new_bits >> k), places, new_bit),
            found + count);
        count += static_cast<unsigned>(__builtin_popcount(chosen));
    }
#else
    for (; bits != 0; bits &= bits - 1) {
        const auto at = static_cast<Index>(__builtin_ctzll(bits));
        found[count++] = TouchingContact(first + at, (new_bits >> at & 1) != 0);
    }
#endif
    return count;
}

/// Appends the pairs at places first + n of a list to those that are chosen, for each bit n of a
/// word; returns the new count. Writes nothing past it.
inline std::size_t append_chosen(std::uint64_t bits,
                                 const PairChoice& choice,
                                 Index first,
                                 std::size_t count) {
#if HWY_TARGET <= HWY_AVX3
    for (Index k = 0; k < 64; k += 16) {
        const auto chosen = static_cast<unsigned>(bits >> k & 0xFFFF);
        store_chosen(chosen, _mm512_loadu_si512(choice.i + first + k), choice.chosen_i + count);
        store_chosen(chosen, _mm512_loadu_si512(choice.j + first + k), choice.chosen_j + count);
        if (choice.place != nullptr) {
            store_chosen(chosen, sixteen_from(first + k), choice.place + count);
        }
        count += static_cast<unsigned>(__builtin_popcount(chosen));
    }
#else
    for (; bits != 0; bits &= bits - 1) {
        const Index place = first + static_cast<Index>(__builtin_ctzll(bits));
        choice.chosen_i[count] = choice.i[place];
        choice.chosen_j[count] = choice.j[place];
        if (choice.place != nullptr) {
            choice.place[count] = place;
        }
        ++count;
    }
#endif
    return count;
}

/// Places of `width` contacts; returns the bits of those that are new.
inline unsigned split_contacts(const TouchingContact* contacts, Index* place) {
#if HWY_TARGET <= HWY_AVX3
    const __m256i all = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(contacts));
    const __m256i new_bit = _mm256_set1_epi32(static_cast<int>(TouchingContact::new_bit));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(place), _mm256_andnot_si256(new_bit, all));
    return static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(all)));
#else
    unsigned new_bits = 0;
    for (Index l = 0; l < width; ++l) {
        place[l] = contacts[l].place();
        new_bits |= static_cast<unsigned>(contacts[l].is_new()) << l;
    }
    return new_bits;
#endif
}

/// Appends the pairs {self, partner[l]}, the lower slot to `i` and the higher to `j`, for each set
/// bit l; returns the new count. Reads eight partners and may write eight elements past the count.
inline std::size_t append_pairs(
    unsigned bits, Index self, const Index* partner, Index* i, Index* j, std::size_t count) {
#if HWY_TARGET <= HWY_AVX3
    const __m256i others = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(partner));
    const __m256i selves = _mm256_set1_epi32(static_cast<int>(self));
    const auto append = [&](Index* to, __m256i slots) {
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(to + count),
                            _mm256_maskz_compress_epi32(static_cast<__mmask8>(bits), slots));
    };
    append(i, _mm256_min_epu32(selves, others));
    append(j, _mm256_max_epu32(selves, others));
    return count + static_cast<std::size_t>(__builtin_popcount(bits));
#else
    for (; bits != 0; bits &= bits - 1) {
        const Index other = partner[__builtin_ctz(bits)];
        i[count] = self < other ? self : other;
        j[count] = self < other ? other : self;
        ++count;
    }
    return count;
#endif
}

}  // namespace grainbench::GRAINBENCH_ISA
