// Passes for avx512; compiled with the flags that core/CMakeLists.txt gives this file.
#define GRAINBENCH_ISA isa_avx512

#include "core/kernels/passes.hpp"

namespace grainbench {

extern const Kernels kernels_avx512;

const Kernels kernels_avx512 = isa_avx512::make_kernels("avx512");

}  // namespace grainbench
