/// Vectors of doubles with operators, over Highway, for the files that are compiled once per
/// instruction set. Each such file defines GRAINBENCH_ISA as its own namespace and is built with
/// the flags of its set; nothing here may be included anywhere else. Only +, -, *, /, sqrt and
/// comparisons are used, all exactly rounded, so every instruction set gives the same bits.
#pragma once

#ifndef GRAINBENCH_ISA
#error "core/simd/lanes.hpp is for the per-instruction-set files of core/kernels only"
#endif

#include "core/kernels/kernels.hpp"
#include "core/types.hpp"

#include <hwy/highway.h>

#include <cstdint>
#include <type_traits>
#include <utility>

// Passes are flattened: laws and helpers are one body with them, so that a block of contacts stays
// in registers from load to store. Not under sanitizers, whose checks would multiply with it.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define GRAINBENCH_FLATTEN
#else
#define GRAINBENCH_FLATTEN [[gnu::flatten]]
#endif

namespace grainbench::GRAINBENCH_ISA {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::ScalableTag<double>;

/// Lanes of one vector.
inline constexpr Index width = hn::MaxLanes(Tag());

struct Mask {
    hn::Mask<Tag> m = hn::FirstN(Tag(), 0);

    friend Mask operator&(Mask a, Mask b) { return {hn::And(a.m, b.m)}; }

    friend Mask operator|(Mask a, Mask b) { return {hn::Or(a.m, b.m)}; }

    friend Mask operator!(Mask a) { return {hn::Not(a.m)}; }

    static Mask all() { return {hn::FirstN(Tag(), width)}; }
};

struct Pack {
    hn::Vec<Tag> v = hn::Zero(Tag());

    Pack() = default;

    Pack(hn::Vec<Tag> vector) : v(vector) {}

    explicit Pack(double x) : v(hn::Set(Tag(), x)) {}

    friend Pack operator+(Pack a, Pack b) { return hn::Add(a.v, b.v); }

    friend Pack operator-(Pack a, Pack b) { return hn::Sub(a.v, b.v); }

    Pack operator-() const { return hn::Neg(v); }

    friend Pack operator*(Pack a, Pack b) { return hn::Mul(a.v, b.v); }

    friend Pack operator/(Pack a, Pack b) { return hn::Div(a.v, b.v); }

    friend Mask operator<(Pack a, Pack b) { return {hn::Lt(a.v, b.v)}; }

    friend Mask operator<=(Pack a, Pack b) { return {hn::Le(a.v, b.v)}; }
};

inline Pack select(Mask mask, Pack yes, Pack no) {
    return hn::IfThenElse(mask.m, yes.v, no.v);
}

/// As grainbench::larger and smaller, zeros of both signs and what is no number included: that is
/// one instruction on these processors, and a comparison where there are no vectors.
inline Pack larger(Pack a, Pack b) {
#if HWY_TARGET == HWY_SCALAR
    return select(a < b, b, a);
#else
    return hn::Max(b.v, a.v);
#endif
}

inline Pack smaller(Pack a, Pack b) {
#if HWY_TARGET == HWY_SCALAR
    return select(a < b, a, b);
#else
    return hn::Min(a.v, b.v);
#endif
}

inline Pack absolute(Pack a) {
    return hn::Abs(a.v);
}

inline Pack square_root(Pack a) {
    return hn::Sqrt(a.v);
}

inline Pack load(const double* from) {
    return hn::LoadU(Tag(), from);
}

inline void store(Pack a, double* to) {
    hn::StoreU(a.v, Tag(), to);
}

/// Lane l set = bit l.
inline unsigned bits_of(Mask mask) {
#if HWY_TARGET <= HWY_AVX3
    return mask.m.raw;
#else
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(Tag(), mask.m, bytes);
    return bytes[0];
#endif
}

inline bool any(Mask mask) {
    return bits_of(mask) != 0;
}

/// Bit l set = lane l.
inline Mask mask_of(unsigned bits) {
    const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits)};
    return {hn::LoadMaskBits(Tag(), bytes)};
}

/// Bits of the first `valid` lanes.
inline unsigned first_bits(Index valid) {
    return valid < width ? (1U << valid) - 1U : (1U << width) - 1U;
}

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

/// One component per pack of the packets of `width` rows.
struct Packets {
    Vec3Of<Pack> xyz;
    Pack w;
};

/// One packet of each of `width` rows in four vectors, in an order that is cheap to turn into
/// components.
struct PacketRows {
    hn::Vec<Tag> part[4];

    Packets components() const {
#if HWY_TARGET == HWY_SCALAR
        return {{Pack(part[0]), Pack(part[1]), Pack(part[2])}, Pack(part[3])};
#elif HWY_MAX_BYTES == 16
        return {{hn::InterleaveLower(Tag(), part[0], part[2]),
                 hn::InterleaveUpper(Tag(), part[0], part[2]),
                 hn::InterleaveLower(Tag(), part[1], part[3])},
                hn::InterleaveUpper(Tag(), part[1], part[3])};
#else
        const auto xz_low = hn::InterleaveLower(Tag(), part[0], part[1]);
        const auto xz_high = hn::InterleaveLower(Tag(), part[2], part[3]);
        const auto yw_low = hn::InterleaveUpper(Tag(), part[0], part[1]);
        const auto yw_high = hn::InterleaveUpper(Tag(), part[2], part[3]);
#if HWY_MAX_BYTES == 32
        return {{hn::ConcatLowerLower(Tag(), xz_high, xz_low),
                 hn::ConcatLowerLower(Tag(), yw_high, yw_low),
                 hn::ConcatUpperUpper(Tag(), xz_high, xz_low)},
                hn::ConcatUpperUpper(Tag(), yw_high, yw_low)};
#else
        constexpr int even_blocks = 0x88;
        constexpr int odd_blocks = 0xDD;
        const auto blocks = [](auto low, auto high, auto which) {
            return Pack(
                hn::Vec<Tag>{_mm512_shuffle_f64x2(low.raw, high.raw, decltype(which)::value)});
        };
        using Even = std::integral_constant<int, even_blocks>;
        using Odd = std::integral_constant<int, odd_blocks>;
        return {{blocks(xz_low, xz_high, Even()),
                 blocks(yw_low, yw_high, Even()),
                 blocks(xz_low, xz_high, Odd())},
                blocks(yw_low, yw_high, Odd())};
#endif
#endif
    }
};

/// Reads one packet of each of the rows row(0) ... row(width - 1) whole.
/// \tparam row_size doubles from row to row
template <std::size_t row_size = 4, class Row>
PacketRows load_rows(const double* column, const Row& row) {
    const auto at = [&](Index l) { return column + row_size * static_cast<std::size_t>(row(l)); };
#if HWY_TARGET == HWY_SCALAR
    const double* p = at(0);
    return {hn::Set(Tag(), p[0]), hn::Set(Tag(), p[1]), hn::Set(Tag(), p[2]), hn::Set(Tag(), p[3])};
#elif HWY_MAX_BYTES == 16
    return {hn::Load(Tag(), at(0)),
            hn::Load(Tag(), at(0) + 2),
            hn::Load(Tag(), at(1)),
            hn::Load(Tag(), at(1) + 2)};
#elif HWY_MAX_BYTES == 32
    return {hn::Load(Tag(), at(0)),
            hn::Load(Tag(), at(1)),
            hn::Load(Tag(), at(2)),
            hn::Load(Tag(), at(3))};
#else
    // Rows 0 and 2, 1 and 3, 4 and 6, 5 and 7 side by side, so that two shuffles leave order.
    const auto two = [&](Index low, Index high) {
        const hn::Half<Tag> half;
        return hn::Combine(Tag(), hn::Load(half, at(high)), hn::Load(half, at(low)));
    };
    return {two(0, 2), two(1, 3), two(4, 6), two(5, 7)};
#endif
}

/// Reads packets and turns them into components: several times faster than gathering each
/// component.
template <std::size_t row_size = 4, class Row>
Packets load_packets(const double* column, const Row& row) {
    return load_rows<row_size>(column, row).components();
}

/// {b.xyz - a.xyz, b.w + a.w} of rows that are side by side: cheaper than components of both.
inline Packets span(const PacketRows& a, const PacketRows& b) {
    alignas(64) static constexpr double signs[8] = {-0.0, -0.0, -0.0, 0.0, -0.0, -0.0, -0.0, 0.0};
    PacketRows result{};
    for (std::size_t k = 0; k < 4; ++k) {
        const auto sign = hn::Load(Tag(), signs + k * width % 4);
        result.part[k] = hn::Add(b.part[k], hn::Xor(a.part[k], sign));
    }
    return result.components();
}

/// Writes lane l as the packet {a, b, c, d} at packets + 4 l.
inline void store_packets(const Vec3Of<Pack>& a, Pack d, double* packets) {
    hn::StoreInterleaved4(a.x.v, a.y.v, a.z.v, d.v, Tag(), packets);
}

/// Elements of a column at positions that are whole numbers held in doubles.
inline Pack look_up(const double* column, Pack position) {
    return hn::GatherIndex(Tag(), column, hn::ConvertTo(hn::RebindToSigned<Tag>(), position.v));
}

/// One packet of four doubles, in as many vectors as it takes.
class Packet {
public:
    explicit Packet(const double* from) {
        each([&](std::size_t k) { part_[k] = hn::Load(Part(), from + k * lanes); });
    }

    explicit Packet(double x) {
        each([&](std::size_t k) { part_[k] = hn::Set(Part(), x); });
    }

    void store(double* to) const {
        each([&](std::size_t k) { hn::Store(part_[k], Part(), to + k * lanes); });
    }

    friend Packet operator+(const Packet& a, const Packet& b) {
        return with(a, b, [](auto x, auto y) { return hn::Add(x, y); });
    }

    friend Packet operator-(const Packet& a, const Packet& b) {
        return with(a, b, [](auto x, auto y) { return hn::Sub(x, y); });
    }

    friend Packet operator*(const Packet& a, const Packet& b) {
        return with(a, b, [](auto x, auto y) { return hn::Mul(x, y); });
    }

    /// Larger by one comparison; b where a is not a number.
    friend Packet larger(const Packet& a, const Packet& b) {
#if HWY_TARGET == HWY_SCALAR
        return with(a, b, [](auto x, auto y) { return hn::IfThenElse(hn::Lt(y, x), x, y); });
#else
        return with(a, b, [](auto x, auto y) { return hn::Max(x, y); });
#endif
    }

    friend Packet absolute(const Packet& a) {
        return with(a, a, [](auto x, auto) { return hn::Abs(x); });
    }

    /// Sizes, which are not negative, with the signs opposite to those of b; 0 where b is 0.
    friend Packet opposed(const Packet& sizes, const Packet& b) {
        return with(sizes, b, [](auto x, auto y) {
            const auto zero = hn::Zero(Part());
            return hn::IfThenElse(
                hn::Lt(zero, y), hn::Neg(x), hn::IfThenElseZero(hn::Lt(y, zero), x));
        });
    }

    /// {sum of a, sum of b, sum of a, sum of b}, each (x + y) + (z + w).
    friend Packet sums(const Packet& a, const Packet& b) {
#if HWY_TARGET == HWY_SCALAR
        const auto sum = [](const Packet& p) {
            return hn::Add(hn::Add(p.part_[0], p.part_[1]), hn::Add(p.part_[2], p.part_[3]));
        };
        Packet result = a;
        result.part_[0] = result.part_[2] = sum(a);
        result.part_[1] = result.part_[3] = sum(b);
        return result;
#else
        const Packet halves = with(a, b, [](auto x, auto y) {
            return hn::Add(hn::InterleaveLower(Part(), x, y), hn::InterleaveUpper(Part(), x, y));
        });
#if HWY_MAX_BYTES == 16
        const auto sum = hn::Add(halves.part_[0], halves.part_[1]);
        return with(a, b, [&](auto, auto) { return sum; });
#else
        return with(halves, halves, [](auto x, auto) {
            return hn::Add(x, hn::ConcatLowerUpper(Part(), x, x));
        });
#endif
#endif
    }

    /// The fourth component in all four places.
    Packet fourth() const {
#if HWY_TARGET == HWY_SCALAR
        return with(*this, *this, [&](auto, auto) { return part_[3]; });
#elif HWY_MAX_BYTES == 16
        const auto w = hn::InterleaveUpper(Part(), part_[1], part_[1]);
        return with(*this, *this, [&](auto, auto) { return w; });
#else
        Packet result = *this;
        result.part_[0] = hn::Vec<Part>{_mm256_permute4x64_pd(part_[0].raw, 0xFF)};
        return result;
#endif
    }

    /// With zero as the fourth component.
    Packet vectors() const {
        return with_fourth(*this, Packet(0.0));
    }

    /// The first three components, and `w` as the fourth.
    friend Packet with_fourth(const Packet& xyz, const Packet& w) {
        Packet result = xyz;
#if HWY_TARGET == HWY_SCALAR
        result.part_[3] = w.part_[3];
#elif HWY_MAX_BYTES == 16
        result.part_[1] = hn::OddEven(w.part_[1], xyz.part_[1]);
#else
        result.part_[0] = hn::Vec<Part>{_mm256_blend_pd(xyz.part_[0].raw, w.part_[0].raw, 8)};
#endif
        return result;
    }

private:
    friend class PacketPair;
    using Part = hn::CappedTag<double, 4>;
    static constexpr std::size_t lanes = hn::MaxLanes(Part());

    template <class Act>
    static void each(const Act& act) {
        for (std::size_t k = 0; k < 4 / lanes; ++k) {
            act(k);
        }
    }

    template <class Act>
    static Packet with(const Packet& a, const Packet& b, const Act& act) {
        Packet result = a;
        each([&](std::size_t k) { result.part_[k] = act(a.part_[k], b.part_[k]); });
        return result;
    }

    hn::Vec<Part> part_[4 / lanes];
};

/// Two packets side by side: one vector where there are such long ones.
class PacketPair {
public:
#if HWY_MAX_BYTES == 64
    PacketPair(const Packet& low, const Packet& high)
        : both_(hn::Combine(Tag(), high.part_[0], low.part_[0])) {}

    explicit PacketPair(const double* from) : both_(hn::Load(Tag(), from)) {}

    void store(double* to) const {
        hn::Store(both_, Tag(), to);
    }

    Packet low() const {
        return half(hn::LowerHalf(both_));
    }

    Packet high() const {
        return half(hn::UpperHalf(hn::Half<Tag>(), both_));
    }

    friend PacketPair operator+(const PacketPair& a, const PacketPair& b) {
        return hn::Add(a.both_, b.both_);
    }

    friend PacketPair operator-(const PacketPair& a, const PacketPair& b) {
        return hn::Sub(a.both_, b.both_);
    }

    friend PacketPair operator*(const PacketPair& a, const PacketPair& b) {
        return hn::Mul(a.both_, b.both_);
    }

    friend PacketPair larger(const PacketPair& a, const PacketPair& b) {
        return hn::Max(a.both_, b.both_);
    }

    /// With zeros as fourth components.
    PacketPair vectors() const {
        return hn::Vec<Tag>{_mm512_maskz_mov_pd(0x77, both_.raw)};
    }

    /// As sums() of the low packets, and of the high ones.
    friend PacketPair sums(const PacketPair& a, const PacketPair& b) {
        const auto halves = hn::Add(hn::InterleaveLower(Tag(), a.both_, b.both_),
                                    hn::InterleaveUpper(Tag(), a.both_, b.both_));
        constexpr int swap_halves = 0x4E;
        return hn::Add(halves, hn::Vec<Tag>{_mm512_permutex_pd(halves.raw, swap_halves)});
    }

private:
    PacketPair(hn::Vec<Tag> both) : both_(both) {}

    static Packet half(hn::Vec<hn::Half<Tag>> v) {
        Packet packet(0.0);
        packet.part_[0] = v;
        return packet;
    }

    hn::Vec<Tag> both_;
#else
    PacketPair(const Packet& low, const Packet& high) : low_(low), high_(high) {}

    explicit PacketPair(const double* from) : low_(from), high_(from + 4) {}

    void store(double* to) const {
        low_.store(to);
        high_.store(to + 4);
    }

    const Packet& low() const {
        return low_;
    }

    const Packet& high() const {
        return high_;
    }

    friend PacketPair operator+(const PacketPair& a, const PacketPair& b) {
        return {a.low_ + b.low_, a.high_ + b.high_};
    }

    friend PacketPair operator-(const PacketPair& a, const PacketPair& b) {
        return {a.low_ - b.low_, a.high_ - b.high_};
    }

    friend PacketPair operator*(const PacketPair& a, const PacketPair& b) {
        return {a.low_ * b.low_, a.high_ * b.high_};
    }

    friend PacketPair larger(const PacketPair& a, const PacketPair& b) {
        return {larger(a.low_, b.low_), larger(a.high_, b.high_)};
    }

    /// With zeros as fourth components.
    PacketPair vectors() const {
        return {low_.vectors(), high_.vectors()};
    }

    /// As sums() of the low packets, and of the high ones.
    friend PacketPair sums(const PacketPair& a, const PacketPair& b) {
        return {sums(a.low_, b.low_), sums(a.high_, b.high_)};
    }

private:
    Packet low_, high_;
#endif
};

/// Two packets in a row for each lane, {a, 0} and {b, 0}, that are added to what is in memory.
class TwinPackets {
public:
#if HWY_MAX_BYTES == 64
    // One vector is a row of both: nothing passes through memory on the way.
    TwinPackets(const Vec3Of<Pack>& a, const Vec3Of<Pack>& b) : a_(a), b_(b) {}

    template <Index lane>
    void add_to(double* row) const {
        store(GRAINBENCH_ISA::load(row) + of<lane>(), row);
    }

    template <Index lane>
    void subtract_from(double* row) const {
        store(GRAINBENCH_ISA::load(row) - of<lane>(), row);
    }

private:
    /// Halves of packets: block n of vector p is of lane 2 n + p.
    struct Halves {
        hn::Vec<Tag> xy[2], z0[2];

        explicit Halves(const Vec3Of<Pack>& v)
            : xy{hn::InterleaveLower(Tag(), v.x.v, v.y.v),
                 hn::InterleaveUpper(Tag(), v.x.v, v.y.v)},
              z0{hn::InterleaveLower(Tag(), v.z.v, hn::Zero(Tag())),
                 hn::InterleaveUpper(Tag(), v.z.v, hn::Zero(Tag()))} {}

        /// {xy, z0} of lanes 0 to 3 or 4 to 7 of a parity.
        template <Index lane>
        __m512d four() const {
            constexpr int blocks = lane < 4 ? 0x44 : 0xEE;
            return _mm512_shuffle_f64x2(xy[lane % 2].raw, z0[lane % 2].raw, blocks);
        }
    };

    template <Index lane>
    Pack of() const {
        constexpr int blocks = lane % 4 < 2 ? 0x88 : 0xDD;
        return hn::Vec<Tag>{
            _mm512_shuffle_f64x2(a_.template four<lane>(), b_.template four<lane>(), blocks)};
    }

    Halves a_, b_;
#else
    TwinPackets(const Vec3Of<Pack>& a, const Vec3Of<Pack>& b) {
        store_packets(a, Pack{}, a_);
        store_packets(b, Pack{}, b_);
    }

    template <Index lane>
    void add_to(double* row) const {
        (Packet(row) + Packet(a_ + 4 * lane)).store(row);
        (Packet(row + 4) + Packet(b_ + 4 * lane)).store(row + 4);
    }

    template <Index lane>
    void subtract_from(double* row) const {
        (Packet(row) - Packet(a_ + 4 * lane)).store(row);
        (Packet(row + 4) - Packet(b_ + 4 * lane)).store(row + 4);
    }

private:
    alignas(64) double a_[4 * width], b_[4 * width];
#endif
};

/// Calls act.template operator()<lane>() for the first `valid` lanes, ascending.
template <class Act>
[[gnu::always_inline]] inline void for_each_lane(Index valid, const Act& act) {
    const auto for_all = [&]<Index... lane>(std::integer_sequence<Index, lane...>)
        __attribute__((always_inline)) {
        if (valid == width) {
            (act.template operator()<lane>(), ...);
        } else {
            ((lane < valid ? act.template operator()<lane>() : void()), ...);
        }
    };
    for_all(std::make_integer_sequence<Index, width>());
}

}  // namespace grainbench::GRAINBENCH_ISA
