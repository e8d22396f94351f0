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

/// Elements of a column at positions that are whole numbers held in doubles.
inline Pack look_up(const double* column, Pack position) {
    return hn::GatherIndex(Tag(), column, hn::ConvertTo(hn::RebindToSigned<Tag>(), position.v));
}

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
