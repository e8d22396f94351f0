/// Which pairs and which wall patches are within reach.
#pragma once

#include "core/kernels/kernels.hpp"
#include "core/simd/packets.hpp"
#include "core/simd/places.hpp"

namespace grainbench::GRAINBENCH_ISA {

/// {centres apart, sum of radii} of a block of pairs.
inline Packets span_of_pairs(const double* position, const Index* i, const Index* j) {
    return span(load_rows(position, [&](Index l) { return i[l]; }),
                load_rows(position, [&](Index l) { return j[l]; }));
}

/// Adds the pairs of one particle with those at places [first, last) of one row of cells. False if
/// room ran out.
inline bool search_row(CellSearch& search, Index place, Index first, Index last) {
    const double* const* at = search.centre;
    const Vec3Of<Pack> centre{Pack(at[0][place]), Pack(at[1][place]), Pack(at[2][place])};
    const Pack radius(search.radius[place]);
    const Index self = search.slot[place];
    for (Index q = first; q < last; q += width) {
        if (search.found + 8 > search.capacity) {
            return false;
        }
        const Vec3Of<Pack> other{load(at[0] + q), load(at[1] + q), load(at[2] + q)};
        const Pack other_radius = load(search.radius + q);
        const Vec3Of<Pack> apart = other - centre;
        const Pack reach = Pack(search.scale) * (radius + other_radius) + Pack(search.extra);
        const Mask close = dot(apart, apart) <= reach * reach;
        const unsigned is_smaller = bits_of(other_radius < radius);
        const unsigned is_larger = bits_of(radius < other_radius);
        const unsigned is_later = place < q ? ~0U : place - q < 31 ? ~0U << (place - q + 1) : 0U;
        const unsigned bits =
            bits_of(close) & first_bits(last - q) & (is_smaller | (~is_larger & is_later));
        search.found = append_pairs(bits, self, search.slot + q, search.i, search.j, search.found);
    }
    return true;
}

GRAINBENCH_FLATTEN inline void search_cells(CellSearch& result) {
    CellSearch search = result;  // that no store of pairs could change
    const CellGrid& grid = search.grid;
    for (; search.next < search.count; ++search.next) {
        const Index place = search.next;
        const std::size_t found_before = search.found;
        const double radius = search.radius[place];
        // The partner is at most as large, so this reach covers every pair that is ours to find.
        const double reach = 2.0 * search.scale * radius + search.extra;
        const bool is_smallest = radius == search.smallest_radius;
        std::int64_t from[3];
        std::int64_t to[3];
        for (int axis = 0; axis < 3; ++axis) {
            const double centre = search.centre[axis][place];
            from[axis] = grid.coordinate(centre - reach, axis);
            to[axis] = grid.coordinate(centre + reach, axis);
        }
        // The smallest meet what comes after them alone, in their row of cells and the next ones.
        const std::int64_t own_z = grid.coordinate(search.centre[2][place], 2);
        const std::int64_t own_y = grid.coordinate(search.centre[1][place], 1);
        for (std::int64_t z = is_smallest ? own_z : from[2]; z <= to[2]; ++z) {
            const bool is_own_layer = is_smallest && z == own_z;
            for (std::int64_t y = is_own_layer ? own_y : from[1]; y <= to[1]; ++y) {
                const std::int64_t row = (z * grid.cells[1] + y) * grid.cells[0];
                const bool is_own = is_own_layer && y == own_y;
                const Index first = is_own ? place + 1 : search.cell_start[row + from[0]];
                const Index last = search.cell_start[row + to[0] + 1];
                if (!search_row(search, place, first, last)) {
                    result.next = search.next;
                    result.found = found_before;
                    return;
                }
            }
        }
    }
    result.next = search.next;
    result.found = search.found;
}

/// Entries of a list of `count` among the 64 that start at `first`.
inline Index entries_of_word(Index first, Index count) {
    return count - first < 64 ? count - first : 64;
}

/// Bits below `count` of the 64 that start at `first`.
inline std::uint64_t valid_bits(Index first, Index count) {
    const Index left = count - first;
    return left < 64 ? (std::uint64_t{1} << left) - 1 : ~std::uint64_t{0};
}

GRAINBENCH_FLATTEN inline void test_pairs(const PairQuery& query, std::uint64_t* within) {
    const Pack scale(query.scale);
    const Pack extra(query.extra);
    for (Index first = 0; first < query.count; first += 64) {
        std::uint64_t word = 0;
        for (Index k = 0; k < entries_of_word(first, query.count); k += width) {
            const Packets both =
                span_of_pairs(query.position, query.i + first + k, query.j + first + k);
            const Pack reach = scale * both.w + extra;
            word |= std::uint64_t{bits_of(dot(both.xyz, both.xyz) <= reach * reach)} << k;
        }
        within[first / 64] = word & valid_bits(first, query.count);
    }
}

GRAINBENCH_FLATTEN inline void test_pairs_and_doubt(const PairQuery& query,
                                                    double margin,
                                                    std::uint64_t* within,
                                                    std::uint64_t* doubtful) {
    const Pack scale(query.scale);
    const Pack extra(query.extra);
    const Pack either_side(margin);
    for (Index first = 0; first < query.count; first += 64) {
        std::uint64_t now = 0;
        std::uint64_t doubt = 0;
        for (Index k = 0; k < entries_of_word(first, query.count); k += width) {
            const Packets both =
                span_of_pairs(query.position, query.i + first + k, query.j + first + k);
            const Pack square = dot(both.xyz, both.xyz);
            const Pack reach = scale * both.w + extra;
            const Pack sure = larger(Pack{}, reach - either_side);
            const Pack possible = reach + either_side;
            now |= std::uint64_t{bits_of(square <= reach * reach)} << k;
            doubt |=
                std::uint64_t{bits_of((square <= possible * possible) & !(square <= sure * sure))}
                << k;
        }
        const std::uint64_t valid = valid_bits(first, query.count);
        within[first / 64] = now & valid;
        doubtful[first / 64] = doubt & valid;
    }
}

inline void list_touching(const std::uint64_t* now,
                          const std::uint64_t* before,
                          std::size_t words,
                          Index first,
                          TouchingContact* touching) {
    std::size_t count = 0;
    for (std::size_t w = 0; w < words; ++w, first += 64) {
        count = append_contacts(now[w], now[w] & ~before[w], first, touching, count);
    }
}

inline std::size_t count_bits(const std::uint64_t* words, std::size_t count) {
    std::size_t bits = 0;
    for (std::size_t w = 0; w < count; ++w) {
        bits += static_cast<std::size_t>(__builtin_popcountll(words[w]));
    }
    return bits;
}

inline void select_pairs(const PairChoice& wanted) {
    const PairChoice choice = wanted;  // that no store of pairs could change
    std::size_t count = 0;
    for (std::size_t w = 0; w < choice.words; ++w) {
        if (choice.bits[w] != 0) {
            const Index first = choice.first + static_cast<Index>(64 * w);
            count = append_chosen(choice.bits[w], choice, first, count);
        }
    }
}

/// Whether a sphere may reach sides of cylinders; true of patches that are none.
inline Mask may_reach_shell(const double* shells,
                            const Index* patch,
                            const Vec3Of<Pack>& place,
                            Pack reach) {
    const Packets line = load_packets(shells, [&](Index l) { return 2 * patch[l]; });
    const Packets base = load_packets(shells, [&](Index l) { return 2 * patch[l] + 1; });
    const Vec3Of<Pack> from = place - base.xyz;
    const Vec3Of<Pack> across = from - dot(line.xyz, from) * line.xyz;
    const Pack square = dot(across, across);
    // Rounding must not hide what just touches.
    const Pack wide = Pack(1.0 + 1e-9) * reach;
    const Pack inner = larger(line.w - wide, Pack{});
    const Pack outer = line.w + wide;
    const Mask near = (inner * inner <= square) & (square <= outer * outer);
    return near | (line.w <= Pack{});
}

GRAINBENCH_FLATTEN inline void test_patches(const PatchQuery& query, const PatchAnswers& answers) {
    const Pack scale(query.scale);
    const Pack extra(query.extra);
    const Vec3Of<Pack> shift{Pack(query.shift[0]), Pack(query.shift[1]), Pack(query.shift[2])};
    Vec3Of<Pack> turn[3];
    for (int r = 0; r < 3; ++r) {
        const double* row = query.rotation + 3 * r;
        turn[r] = {Pack(row[0]), Pack(row[1]), Pack(row[2])};
    }
    for (Index first = 0; first < query.count; first += 64) {
        std::uint64_t face = 0;
        std::uint64_t doubt = 0;
        for (Index k = 0; k < entries_of_word(first, query.count); k += width) {
            const Index* particle = query.particle + first + k;
            const Index* patch = query.patch + first + k;
            const Packets sphere =
                load_packets(query.position, [&](Index l) { return particle[l]; });
            const auto plane = [&](Index n) {
                return load_packets(query.planes, [&](Index l) { return 4 * patch[l] + n; });
            };
            Vec3Of<Pack> place = sphere.xyz - shift;
            if (query.rotated) {
                place = {dot(turn[0], place), dot(turn[1], place), dot(turn[2], place)};
            }
            const Packets surface = plane(0);
            const Pack height = dot(surface.xyz, place) - surface.w;
            store(height, answers.height + first + k);
            const Pack reach = scale * sphere.w + extra;
            const Mask level = absolute(height) <= reach;
            if (bits_of(level) == 0) {
                continue;
            }
            // Rounding must not make a face of what lies on its edge.
            const Pack margin = Pack(1e-9) * reach;
            const auto inside = [&](Index n) {
                const Packets side = plane(n);
                return dot(side.xyz, place) - side.w;
            };
            const Pack least = smaller(inside(1), smaller(inside(2), inside(3)));
            const Mask in_face = margin < least;
            // Outside a side by so much the patch is at least this far.
            const Pack outside = smaller(least, Pack{});
            Mask may_touch =
                height * height + outside * outside <= Pack(1.0 + 1e-9) * reach * reach;
            if (query.shells != nullptr) {
                may_touch = may_touch & may_reach_shell(query.shells, patch, place, reach);
            }
            face |= std::uint64_t{bits_of(level & in_face)} << k;
            doubt |= std::uint64_t{bits_of(level & may_touch & !in_face)} << k;
        }
        const std::uint64_t valid = valid_bits(first, query.count);
        answers.face[first / 64] = face & valid;
        answers.doubt[first / 64] = doubt & valid;
    }
}

}  // namespace grainbench::GRAINBENCH_ISA
