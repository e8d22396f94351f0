// Passes for scalar; compiled with the flags that core/CMakeLists.txt gives this file.
#define GRAINBENCH_ISA isa_scalar

#include "core/kernels/passes.hpp"

namespace grainbench {

extern const Kernels kernels_scalar;

const Kernels kernels_scalar = isa_scalar::make_kernels("scalar");

}  // namespace grainbench
