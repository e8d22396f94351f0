// Loops for sse4; compiled with the flags that cli/bench/CMakeLists.txt gives this file.
#define GRAINBENCH_ISA bench_sse4

#include "cli/bench/loops.hpp"

namespace grainbench::cli {

extern const MachineLoops loops_sse4;

const MachineLoops loops_sse4 = bench_sse4::machine_loops;

}  // namespace grainbench::cli
