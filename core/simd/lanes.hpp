/// Vectors of doubles with operators, over Highway, for the files that are compiled once per
/// instruction set. Each such file defines GRAINBENCH_ISA as its own namespace and is built with
/// the flags of its set; nothing here may be included anywhere else. Only +, -, *, /, sqrt and
/// comparisons are used, all exactly rounded, so every instruction set gives the same bits.
#pragma once

#ifndef GRAINBENCH_ISA
#error "core/simd/lanes.hpp is for the per-instruction-set files of core/kernels only"
#endif

#include "core/types.hpp"

#include <hwy/highway.h>

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

    friend Pack operator*(Pack a, Pack b) { return hn::Mul(a.v, b.v); }

    friend Pack operator/(Pack a, Pack b) { return hn::Div(a.v, b.v); }

    friend Mask operator<(Pack a, Pack b) { return {hn::Lt(a.v, b.v)}; }

    friend Mask operator<=(Pack a, Pack b) { return {hn::Le(a.v, b.v)}; }
};

inline Pack select(Mask mask, Pack yes, Pack no) {
    return hn::IfThenElse(mask.m, yes.v, no.v);
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
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(Tag(), mask.m, bytes);
    return bytes[0];
}

/// Positions of `width` rows in a column; rows of packets are four doubles apart.
class Rows {
public:
    /// Reads `width` indices.
    explicit Rows(const Index* rows)
        : offsets_(hn::PromoteTo(Offsets(),
                                 hn::LoadU(hn::Rebind<std::int32_t, Tag>(),
                                           reinterpret_cast<const std::int32_t*>(rows)))),
          packet_offsets_(hn::ShiftLeft<2>(offsets_)) {}

    /// Component of the packet of each row.
    Pack packet(const double* packets, int component) const {
        return hn::GatherIndex(Tag(), packets + component, packet_offsets_);
    }

    Vec3Of<Pack> vector(const double* packets) const {
        return {packet(packets, 0), packet(packets, 1), packet(packets, 2)};
    }

    /// Element of a plain column of each row.
    Pack element(const double* column) const { return hn::GatherIndex(Tag(), column, offsets_); }

private:
    using Offsets = hn::RebindToSigned<Tag>;
    hn::Vec<Offsets> offsets_;
    hn::Vec<Offsets> packet_offsets_;
};

/// Elements of a column at positions that are whole numbers held in doubles.
inline Pack look_up(const double* column, Pack position) {
    return hn::GatherIndex(Tag(), column, hn::ConvertTo(hn::RebindToSigned<Tag>(), position.v));
}

/// Writes lane l as the packet {a, b, c, 0} at packets + 4 l.
inline void store_packets(const Vec3Of<Pack>& a, double* packets) {
    hn::StoreInterleaved4(a.x.v, a.y.v, a.z.v, hn::Zero(Tag()), Tag(), packets);
}

}  // namespace grainbench::GRAINBENCH_ISA
