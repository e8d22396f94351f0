// Loops for avx512; compiled with the flags that cli/bench/CMakeLists.txt gives this file.
#define GRAINBENCH_ISA bench_avx512

#include "cli/bench/loops.hpp"

namespace grainbench::cli {

extern const MachineLoops loops_avx512;

const MachineLoops loops_avx512 = bench_avx512::machine_loops;

}  // namespace grainbench::cli
