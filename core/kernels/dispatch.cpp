#include "core/error.hpp"
#include "core/kernels/kernels.hpp"

#include <array>
#include <cstdlib>
#include <string>

namespace grainbench {

extern const Kernels kernels_scalar;
extern const Kernels kernels_sse4;
extern const Kernels kernels_avx2;
extern const Kernels kernels_avx512;

namespace {

struct Candidate {
    const Kernels* kernels;
    bool (*available)();
};

/// Slowest first.
const std::array<Candidate, 4> candidates{{
    {&kernels_scalar, [] { return true; }},
    {&kernels_sse4, [] { return __builtin_cpu_supports("sse4.2") != 0; }},
    {&kernels_avx2,
     [] {
         return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0 &&
                __builtin_cpu_supports("bmi2") != 0;
     }},
    {&kernels_avx512,
     [] {
         return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512bw") != 0 &&
                __builtin_cpu_supports("avx512dq") != 0 && __builtin_cpu_supports("avx512vl") != 0;
     }},
}};

}  // namespace

std::string_view available_isa(std::size_t n) {
    for (const Candidate& candidate : candidates) {
        if (candidate.available() && n-- == 0) {
            return candidate.kernels->isa;
        }
    }
    return "";
}

const Kernels& kernels_for(std::string_view isa) {
    if (isa.empty()) {
        const char* wanted = std::getenv("GRAINBENCH_ISA");
        isa = wanted != nullptr ? wanted : "";
    }
    const Kernels* best = nullptr;
    for (const Candidate& candidate : candidates) {
        if (candidate.available() && (isa.empty() || candidate.kernels->isa == isa)) {
            best = candidate.kernels;
        }
    }
    if (best == nullptr) {
        std::string names;
        for (std::size_t n = 0; !available_isa(n).empty(); ++n) {
            names += (n == 0 ? "" : ", ") + std::string(available_isa(n));
        }
        throw_bad_input({.what = "no instruction set '" + std::string(isa) + "' on this processor",
                         .where = "GRAINBENCH_ISA",
                         .likely_cause = "a name that is not known, or an older processor",
                         .next_step = "use one of: " + names});
    }
    return *best;
}

}  // namespace grainbench
