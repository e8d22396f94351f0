#include "cli/bench/timing.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <numeric>

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

/// Slices between two looks at all particles.
constexpr std::uint64_t frame_interval = 10;

double loaded_count(const Simulation& simulation) {
    const ParticleFrame frame = simulation.particle_frame();
    return static_cast<double>(std::count_if(
        frame.contacts.begin(), frame.contacts.end(), [](auto count) { return count > 0; }));
}

}  // namespace

void BenchRun::prepare() {
    if (simulation_) {
        return;
    }
    SimulationOptions options;
    options.threads = threads_;
    simulation_.emplace(case_.scene(), 0, options);
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
    double loaded = 0.0;
    std::uint64_t slices = 0;
    while (simulation.time() < end) {
        const auto wall_start = Clock::now();
        const double cpu_start = thread_cpu_seconds();
        simulation.advance(slice, nobody);
        timing.cpu_seconds += thread_cpu_seconds() - cpu_start;
        timing.wall_seconds += std::chrono::duration<double>(Clock::now() - wall_start).count();
        if (slices++ % frame_interval == 0) {
            loaded = loaded_count(simulation);
        }
        timing.loaded += slice * loaded;
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

PhaseTimes BenchRun::time_phases() {
    const auto sum = [](const PhaseTimes& times) {
        return std::accumulate(times.begin(), times.end(), 0.0);
    };
    PhaseTimes best = time_phases_of_one_span();
    for (int more = 0; more < 2; ++more) {
        const PhaseTimes times = time_phases_of_one_span();
        best = sum(times) < sum(best) ? times : best;
    }
    return best;
}

PhaseTimes BenchRun::time_phases_of_one_span() {
    Simulation& simulation = *simulation_;
    Observer nobody;
    PhaseClock clock;
    const std::uint64_t first = simulation.cycle();
    const double end = simulation.time() + case_.span;
    simulation.watch_phases(&clock);
    while (simulation.time() < end) {
        simulation.advance(slice, nobody);
        clock.stop();
    }
    simulation.watch_phases(nullptr);
    const double particle_steps = static_cast<double>(simulation.cycle() - first) *
                                  static_cast<double>(simulation.particle_count());
    PhaseTimes times = clock.seconds();
    for (double& time : times) {
        time /= particle_steps;
    }
    return times;
}

}  // namespace grainbench::cli
