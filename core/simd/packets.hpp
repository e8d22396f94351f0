/// Packets of four doubles (share/doc/decisions/0002-packets-of-four.md) as vectors: rows of them
/// as components in lanes and back, one by one, and two side by side.
#pragma once

#include "core/simd/lanes.hpp"

namespace grainbench::GRAINBENCH_ISA {

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
template <class Row>
PacketRows load_rows(const double* column, const Row& row) {
    const auto at = [&](Index l) { return column + 4 * static_cast<std::size_t>(row(l)); };
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
template <class Row>
Packets load_packets(const double* column, const Row& row) {
    return load_rows(column, row).components();
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
    Packet without_fourth() const {
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
    PacketPair without_fourth() const {
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
    PacketPair without_fourth() const {
        return {low_.without_fourth(), high_.without_fourth()};
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

}  // namespace grainbench::GRAINBENCH_ISA
