// Passes for sse4; compiled with the flags that core/CMakeLists.txt gives this file.
#define GRAINBENCH_ISA isa_sse4

#include "core/kernels/passes.hpp"

namespace grainbench {

extern const Kernels kernels_sse4;

const Kernels kernels_sse4{"sse4",
                           &isa_sse4::move,
                           &isa_sse4::find_pairs,
                           &isa_sse4::find_patches,
                           &isa_sse4::choose_pair_pass,
                           &isa_sse4::choose_wall_pass};

}  // namespace grainbench
