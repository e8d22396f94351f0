// Loops for scalar; compiled with the flags that cli/bench/CMakeLists.txt gives this file.
#define GRAINBENCH_ISA bench_scalar

#include "cli/bench/loops.hpp"

namespace grainbench::cli {

extern const MachineLoops loops_scalar;

const MachineLoops loops_scalar = bench_scalar::machine_loops;

}  // namespace grainbench::cli
