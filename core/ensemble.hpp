/// Runs the realisations of a scene side by side, one thread per realisation at a time, in slices,
/// so that no core idles while one realisation is left. The result of each depends on nothing but
/// itself.
#pragma once

#include "core/error.hpp"
#include "core/simulation.hpp"

#include <atomic>
#include <functional>
#include <span>

namespace grainbench {

/// Where an ensemble is, for a progress line. Sums over its realisations.
struct EnsembleProgress {
    double fraction = 0.0;        ///< [1] of simulated time done
    double particle_steps = 0.0;  ///< since the call
    double wall_seconds = 0.0;    ///< since the call
    double timestep = 0.0;        ///< [s] of the slice that just ended
    double time = 0.0;            ///< [s] least of all realisations
};

struct EnsembleOptions {
    unsigned threads = 1;
    std::uint64_t slice = 2000;  ///< cycles between two looks at `stop`
};

/// What one realisation cost.
struct RealisationCost {
    double wall_seconds = 0.0;  ///< in its slices
    double cpu_seconds = 0.0;
};

/// An Error of one realisation, which the others survive.
class RealisationError : public Error {
public:
    RealisationError(const Error& error,
                     std::size_t realisation,
                     std::vector<RealisationCost> costs)
        : Error(error), realisation_(realisation), costs_(std::move(costs)) {}

    /// Its place in the span, from 0.
    std::size_t realisation() const { return realisation_; }

    /// Of all realisations until they stopped.
    const std::vector<RealisationCost>& costs() const { return costs_; }

private:
    std::size_t realisation_;
    std::vector<RealisationCost> costs_;
};

/// Runs until all have finished, or `stop` becomes true at the end of a slice.
/// \param observers one per simulation; called from the thread that runs it
/// \param progress called now and then, from one thread at a time; may be empty
/// \return costs, one per simulation. An Error of any realisation is thrown, as RealisationError,
/// after the others paused.
std::vector<RealisationCost> run_ensemble(
    std::span<Simulation> simulations,
    std::span<Observer* const> observers,
    const EnsembleOptions& options,
    const std::atomic<bool>& stop,
    const std::function<void(const EnsembleProgress&)>& progress);

}  // namespace grainbench
