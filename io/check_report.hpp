/// What `grainbench check` found out about a scene without running it; as JSON for scripts.
#pragma once

#include "core/effects.hpp"
#include "core/insertion/insert.hpp"
#include "core/measure/contact_scales.hpp"
#include "core/measure/softening.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace grainbench::io {

/// Numbers of one stage; `contact` has the laws in effect there.
struct StageCheck {
    std::string name;
    double duration = 0.0;          ///< [s]
    std::vector<std::string> laws;  ///< of a contact, in order
    ContactScales scales;
    std::string scheme;                       ///< of the timestep
    double planned_timestep = 0.0;            ///< [s] with one lone contact; fewer in a dense bed
    std::optional<double> steps_per_contact;  ///< [1] of the shortest; none if time has no meaning
    double expected_cycles = 0.0;             ///< [1]
    std::optional<Softening> softening;       ///< none without contacts or speed
};

/// Cycles stepped only to be timed.
struct TrialRun {
    double wall_seconds = 0.0;
    std::uint64_t cycles = 0;
    double particle_steps_per_second = 0.0;  ///< one thread, without output
    double timestep = 0.0;                   ///< [s] of the last cycle
    /// Parts of a cycle and their shares of its time [1]; empty if the run ended in the trial.
    std::vector<std::pair<std::string, double>> shares;
};

struct DetectionCheck {
    std::string trigger;
    double tolerance = 0.0;                 ///< [m] of the smallest sphere
    std::optional<double> surest_approach;  ///< [m/s] with an interval only
    double fastest_now = 0.0;               ///< [m/s] of walls, and of particles after the trial
};

struct CheckReport {
    std::vector<Effect> effects;
    std::vector<std::string> warnings;
    std::int64_t realisations = 1;
    std::size_t particles = 0;  ///< of the first realisation
    std::vector<InsertionReport> insertion;
    std::vector<StageCheck> stages;
    DetectionCheck detection;
    TrialRun trial;
    double memory_bytes = 0.0;      ///< of all realisations
    int threads = 1;                ///< that the time is for
    double expected_seconds = 0.0;  ///< of wall time
};

/// \param effective_scene JSON text, put in as the member "scene"
std::string to_json(const CheckReport& report, const std::string& effective_scene);

}  // namespace grainbench::io
