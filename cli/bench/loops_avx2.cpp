// Loops for avx2; compiled with the flags that cli/bench/CMakeLists.txt gives this file.
#define GRAINBENCH_ISA bench_avx2

#include "cli/bench/loops.hpp"

namespace grainbench::cli {

extern const MachineLoops loops_avx2;

const MachineLoops loops_avx2 = bench_avx2::machine_loops;

}  // namespace grainbench::cli
