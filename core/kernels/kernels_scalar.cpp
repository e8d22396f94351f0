// Passes for scalar; compiled with the flags that core/CMakeLists.txt gives this file.
#define GRAINBENCH_ISA isa_scalar

#include "core/kernels/passes.hpp"

namespace grainbench {

extern const Kernels kernels_scalar;

const Kernels kernels_scalar{"scalar",
                             &isa_scalar::move,
                             &isa_scalar::find_pairs,
                             &isa_scalar::find_patches,
                             &isa_scalar::choose_pair_pass,
                             &isa_scalar::choose_wall_pass};

}  // namespace grainbench
