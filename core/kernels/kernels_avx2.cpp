// Passes for avx2; compiled with the flags that core/CMakeLists.txt gives this file.
#define GRAINBENCH_ISA isa_avx2

#include "core/kernels/passes.hpp"

namespace grainbench {

extern const Kernels kernels_avx2;

const Kernels kernels_avx2 = isa_avx2::make_kernels("avx2");

}  // namespace grainbench
