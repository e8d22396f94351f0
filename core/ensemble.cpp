#include "core/ensemble.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <exception>
#include <mutex>
#include <thread>

namespace grainbench {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Of the calling thread or, where one simulation has all threads to itself, of the process.
double cpu_seconds(bool of_process) {
    timespec now{};
    clock_gettime(of_process ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The queue of realisations that wait for a thread.
class Runner {
public:
    Runner(std::span<Simulation> simulations,
           std::span<Observer* const> observers,
           const EnsembleOptions& options,
           const std::atomic<bool>& stop,
           const std::function<void(const EnsembleProgress&)>& progress)
        : simulations_(simulations),
          observers_(observers),
          options_(options),
          stop_(stop),
          progress_(progress),
          costs_(simulations.size()),
          times_(simulations.size()) {
        for (std::size_t n = 0; n < simulations.size(); ++n) {
            times_[n] = simulations[n].time();
            end_time_ = std::max(end_time_, simulations[n].end_time());
            if (!simulations[n].finished()) {
                waiting_.push_back(n);
            }
        }
    }

    std::vector<RealisationCost> run() {
        const std::size_t wanted = std::max(1U, options_.threads);
        const std::size_t count = std::min(wanted, std::max<std::size_t>(1, waiting_.size()));
        {
            std::vector<std::jthread> threads;
            for (std::size_t t = 1; t < count; ++t) {
                threads.emplace_back([this] { work(); });
            }
            work();
        }
        if (failure_) {
            rethrow();
        }
        return costs_;
    }

private:
    [[noreturn]] void rethrow() const {
        try {
            std::rethrow_exception(failure_);
        } catch (const Error& error) {
            throw RealisationError(error, failed_, costs_);
        }
    }

    void work() {
        std::unique_lock lock(mutex_);
        while (!waiting_.empty() && !failure_ && !stop_) {
            const std::size_t n = take_the_hindmost();
            lock.unlock();
            const bool unfinished = run_slice(n);
            lock.lock();
            if (unfinished) {
                waiting_.push_back(n);
            }
        }
    }

    /// The realisation that waits with the least simulated time: their steps differ, and one left
    /// behind would run alone at the end.
    std::size_t take_the_hindmost() {
        const auto hindmost =
            std::min_element(waiting_.begin(), waiting_.end(), [&](std::size_t a, std::size_t b) {
                return times_[a] < times_[b];
            });
        const std::size_t n = *hindmost;
        waiting_.erase(hindmost);
        return n;
    }

    bool run_slice(std::size_t n) {
        Simulation& simulation = simulations_[n];
        const auto start = Clock::now();
        const bool alone = simulations_.size() == 1;
        const double cpu_start = cpu_seconds(alone);
        const std::uint64_t first_cycle = simulation.cycle();
        bool finished = false;
        std::exception_ptr failure;
        try {
            finished = simulation.advance(options_.slice, *observers_[n]);
        } catch (...) {
            failure = std::current_exception();
        }
        const std::lock_guard lock(mutex_);
        costs_[n].wall_seconds += seconds_since(start);
        costs_[n].cpu_seconds += cpu_seconds(alone) - cpu_start;
        particle_steps_ += static_cast<double>(simulation.cycle() - first_cycle) *
                           static_cast<double>(simulation.particle_count());
        times_[n] = simulation.time();
        if (failure && !failure_) {
            failure_ = failure;
            failed_ = n;
        }
        report(simulation.timestep());
        return !finished && !failure;
    }

    void report(double timestep) const {
        if (!progress_) {
            return;
        }
        double sum = 0.0;
        for (const double t : times_) {
            sum += end_time_ > 0.0 ? std::min(1.0, t / end_time_) : 1.0;
        }
        progress_({.fraction = sum / static_cast<double>(times_.size()),
                   .particle_steps = particle_steps_,
                   .wall_seconds = seconds_since(start_),
                   .timestep = timestep,
                   .time = *std::min_element(times_.begin(), times_.end())});
    }

    std::span<Simulation> simulations_;
    std::span<Observer* const> observers_;
    const EnsembleOptions& options_;
    const std::atomic<bool>& stop_;
    const std::function<void(const EnsembleProgress&)>& progress_;
    const Clock::time_point start_ = Clock::now();
    std::mutex mutex_;
    std::vector<std::size_t> waiting_;
    std::vector<RealisationCost> costs_;
    std::vector<double> times_;
    double end_time_ = 0.0;
    double particle_steps_ = 0.0;
    std::exception_ptr failure_;
    std::size_t failed_ = 0;  ///< whose failure it is
};

}  // namespace

std::vector<RealisationCost> run_ensemble(
    std::span<Simulation> simulations,
    std::span<Observer* const> observers,
    const EnsembleOptions& options,
    const std::atomic<bool>& stop,
    const std::function<void(const EnsembleProgress&)>& progress) {
    return Runner(simulations, observers, options, stop, progress).run();
}

}  // namespace grainbench
