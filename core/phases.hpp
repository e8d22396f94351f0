/// The parts of a cycle, for those who want to know where its time goes (`grainbench bench`).
#pragma once

#include <cstddef>

namespace grainbench {

enum class Phase {
    timestep,     ///< choice of the step, sums over contacts that bound it
    integration,  ///< motion of particles and walls
    detection,    ///< lists of pairs, and which pairs touch
    contacts,     ///< laws between particles
    walls,        ///< lists, tests and laws of contacts with walls
    output        ///< energies, samples, and whatever is due to be written
};

inline constexpr std::size_t phase_count = 6;

/// Told when a part of a cycle begins, which ends the part before it. Without a watch the engine
/// asks one pointer per part, some ten times per cycle, and the passes know nothing of it.
class PhaseWatch {
public:
    virtual ~PhaseWatch() = default;

    virtual void enter(Phase phase) = 0;
};

}  // namespace grainbench
