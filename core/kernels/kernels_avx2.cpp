// Passes for avx2; compiled with the flags that core/CMakeLists.txt gives this file.
#define GRAINBENCH_ISA isa_avx2

#include "core/kernels/passes.hpp"

namespace grainbench {

extern const Kernels kernels_avx2;

const Kernels kernels_avx2{"avx2",
                           &isa_avx2::move,
                           &isa_avx2::find_pairs,
                           &isa_avx2::find_patches,
                           &isa_avx2::choose_pair_pass,
                           &isa_avx2::choose_wall_pass};

}  // namespace grainbench
