/// What a run was: who computed what, on which machine, and how fast. Written as manifest.json.
#pragma once

#include "core/insertion/insert.hpp"
#include "core/simulation.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace grainbench::io {

/// Seconds and rates are those of the calls that made `timed_cycles`: all cycles, unless the run
/// was killed on the way.
struct RealisationManifest {
    std::int64_t seed = 0;
    std::uint64_t particles = 0;
    std::uint64_t cycles = 0;
    std::uint64_t timed_cycles = 0;
    double wall_seconds = 0.0;
    double cpu_seconds = 0.0;
    double particle_steps_per_second = 0.0;  ///< by the clock on the wall
    std::vector<InsertionReport> insertion;
    Summary summary;
    std::uint64_t state_hash = 0;  ///< of the last state; equal for equal runs

    /// Seconds of processor time per particle-step; 0 where nothing was timed.
    double step_time() const;
};

struct Manifest {
    std::string version;
    std::string git_hash;
    std::string compiler;
    std::string compiler_flags;
    std::string cpu;
    std::string isa;  ///< instruction set of the passes
    int threads = 1;
    std::string outcome;               ///< "finished", "interrupted" or "unstable"
    std::string message;               ///< what stopped the run, if something did
    std::vector<std::string> effects;  ///< names of the effects that the scene turns on
    double wall_seconds = 0.0;
    std::vector<RealisationManifest> realisations;
};

std::string to_json(const Manifest& manifest);

/// What to_json wrote. Error(input_output) that names the file if it is missing or damaged.
Manifest read_manifest(const std::filesystem::path& file);

}  // namespace grainbench::io
