#include "cli/bench/machine.hpp"

#include <algorithm>
#include <chrono>
#include <vector>

namespace grainbench::cli {

extern const MachineLoops loops_scalar;
extern const MachineLoops loops_sse4;
extern const MachineLoops loops_avx2;
extern const MachineLoops loops_avx512;

namespace {

constexpr int tries = 7;

/// Long enough for the clock, short enough to fall between two disturbances.
constexpr double bytes_per_try = 5e7;
constexpr std::size_t rounds_per_try = 200000;

const MachineLoops& loops_of(std::string_view isa) {
    return isa == "avx512" ? loops_avx512
           : isa == "avx2" ? loops_avx2
           : isa == "sse4" ? loops_sse4
                           : loops_scalar;
}

template <class Act>
double least_seconds(const Act& act) {
    double least = 1e300;
    for (int k = 0; k < tries; ++k) {
        const auto start = std::chrono::steady_clock::now();
        act();
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
        least = std::min(least, taken.count());
    }
    return least;
}

}  // namespace

MachineSpeed measure_speed(std::string_view isa, double working_set) {
    const MachineLoops& loops = loops_of(isa);
    const auto count = static_cast<std::size_t>(std::max(working_set, 3000.0) / 24.0);
    const double bytes = 24.0 * static_cast<double>(count);
    const auto sweeps = static_cast<std::size_t>(bytes_per_try / bytes) + 1;
    std::vector<double> a(count);
    const std::vector<double> b(count, 1.0);
    const std::vector<double> c(count, 2.0);
    const double triad_seconds = least_seconds([&] {
        for (std::size_t k = 0; k < sweeps; ++k) {
            loops.triad(a.data(), b.data(), c.data(), count);
        }
    });
    volatile double result = 0.0;
    const double fma_seconds = least_seconds([&] { result = loops.multiply_add(rounds_per_try); });
    return {.bandwidth = static_cast<double>(sweeps) * bytes / triad_seconds,
            .peak = static_cast<double>(rounds_per_try) * loops.operations_per_round / fma_seconds};
}

}  // namespace grainbench::cli
