// Steps the scenes of counted_cases() under callgrind, with the scalar passes, which look the same
// on every processor. Counting is off while a scene is built and settles, and each scene leaves its
// counts in a file of its own. Prints the particle-steps that were counted.
#include "core/simulation.hpp"

#include "cli/bench/cases.hpp"

#include <valgrind/callgrind.h>

#include <iostream>

int main() {
    using namespace grainbench;
    Observer nobody;
    for (const cli::BenchCase& counted : cli::counted_cases()) {
        Simulation simulation(counted.scene(), 0, {.isa = "scalar"});
        while (simulation.time() < counted.prepared) {
            simulation.advance(1, nobody);
        }
        const double end = simulation.time() + counted.span;
        const std::uint64_t first = simulation.cycle();
        CALLGRIND_START_INSTRUMENTATION;
        CALLGRIND_ZERO_STATS;
        while (simulation.time() < end) {
            simulation.advance(1, nobody);
        }
        CALLGRIND_DUMP_STATS_AT(counted.name.c_str());
        CALLGRIND_STOP_INSTRUMENTATION;
        std::cout << counted.name << " "
                  << (simulation.cycle() - first) * simulation.particle_count() << "\n";
    }
}
