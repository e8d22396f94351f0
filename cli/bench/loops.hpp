/// What a processor can do at best in one instruction set: two loops, compiled once per set like
/// the passes of the engine (share/doc/decisions/0001-one-source-file-per-instruction-set.md).
#pragma once

#include "cli/bench/machine.hpp"

#include <hwy/highway.h>

namespace grainbench::cli::GRAINBENCH_ISA {

namespace hn = hwy::HWY_NAMESPACE;

/// a = b + factor c, the triad of the STREAM benchmark.
inline void triad(double* a, const double* b, const double* c, std::size_t count) {
    const hn::ScalableTag<double> tag;
    const std::size_t width = hn::Lanes(tag);
    const auto factor = hn::Set(tag, 3.0);
    std::size_t k = 0;
    for (; k + 4 * width <= count; k += 4 * width) {
        for (std::size_t part = 0; part < 4; ++part) {
            const std::size_t at = k + part * width;
            hn::StoreU(
                hn::MulAdd(factor, hn::LoadU(tag, c + at), hn::LoadU(tag, b + at)), tag, a + at);
        }
    }
    for (; k < count; ++k) {
        a[k] = b[k] + 3.0 * c[k];
    }
}

/// Multiply-adds in chains that do not wait for each other; returns a sum, so that they are not
/// left out.
inline double multiply_add(std::size_t rounds) {
    constexpr int chains = 12;  // four cycles of latency on two units need 8
    const hn::ScalableTag<double> tag;
    const auto factor = hn::Set(tag, 0.999);
    const auto term = hn::Set(tag, 0.001);
    hn::Vec<decltype(tag)> x[chains];
    for (int k = 0; k < chains; ++k) {
        x[k] = hn::Set(tag, 1.0 + k);
    }
    for (std::size_t round = 0; round < rounds; ++round) {
#pragma GCC unroll 12
        for (int k = 0; k < chains; ++k) {
            x[k] = hn::MulAdd(x[k], factor, term);
        }
    }
    auto sum = hn::Zero(tag);
    for (int k = 0; k < chains; ++k) {
        sum = hn::Add(sum, x[k]);
    }
    return hn::GetLane(hn::SumOfLanes(tag, sum));
}

inline constexpr MachineLoops machine_loops{
    .triad = &triad,
    .multiply_add = &multiply_add,
    .operations_per_round = 12.0 * 2.0 * hn::MaxLanes(hn::ScalableTag<double>())};

}  // namespace grainbench::cli::GRAINBENCH_ISA
