// Passes for avx512; compiled with the flags that core/CMakeLists.txt gives this file.
#define GRAINBENCH_ISA isa_avx512

#include "core/kernels/passes.hpp"

namespace grainbench {

extern const Kernels kernels_avx512;

const Kernels kernels_avx512{"avx512",
                             &isa_avx512::move,
                             &isa_avx512::find_pairs,
                             &isa_avx512::find_patches,
                             &isa_avx512::choose_pair_pass,
                             &isa_avx512::choose_wall_pass};

}  // namespace grainbench
