// Passes for sse4; compiled with the flags that core/CMakeLists.txt gives this file.
#define GRAINBENCH_ISA isa_sse4

#include "core/kernels/passes.hpp"

namespace grainbench {

extern const Kernels kernels_sse4;

const Kernels kernels_sse4 = isa_sse4::make_kernels("sse4");

}  // namespace grainbench
