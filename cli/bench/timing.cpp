#include "cli/bench/timing.hpp"

#include <chrono>
#include <ctime>

namespace grainbench::cli {

namespace {

using Clock = std::chrono::steady_clock;

/// Cycles between two looks at the clock and at the counts; a look costs far less than a cycle.
constexpr std::uint64_t slice = 20;

double thread_cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

void BenchRun::prepare() {
    if (simulation_) {
        return;
    }
    simulation_.emplace(case_.scene(), 0);
    Observer nobody;
    while (simulation_->time() < case_.prepared) {
        simulation_->advance(slice, nobody);
    }
}

BenchTiming BenchRun::time_one_span() {
    Simulation& simulation = *simulation_;
    Observer nobody;
    BenchTiming timing;
    const Summary before = simulation.summary();
    const double end = simulation.time() + case_.span;
    while (simulation.time() < end) {
        const auto wall_start = Clock::now();
        const double cpu_start = thread_cpu_seconds();
        simulation.advance(slice, nobody);
        timing.cpu_seconds += thread_cpu_seconds() - cpu_start;
        timing.wall_seconds += std::chrono::duration<double>(Clock::now() - wall_start).count();
        timing.touching += slice * static_cast<double>(simulation.touching_count());
        timing.objects += slice * static_cast<double>(simulation.contact_count());
        timing.candidates += slice * static_cast<double>(simulation.candidate_count());
    }
    const Summary after = simulation.summary();
    timing.simulated = after.time - before.time;
    timing.cycles = static_cast<double>(after.cycles - before.cycles);
    timing.particle_steps = timing.cycles * static_cast<double>(simulation.particle_count());
    timing.searches = static_cast<double>(after.searches - before.searches);
    timing.candidate_builds = static_cast<double>(after.candidate_builds - before.candidate_builds);
    return timing;
}

}  // namespace grainbench::cli
