/// Runs many scenes, each into its folder of a cache, on several threads: what studies and figure
/// sets are made of. Realisations are the units, taken in the order of the jobs, each by one
/// thread from its beginning to its end. Runs that the cache holds are not repeated; those that
/// were interrupted go on.
///
///     const Interrupt interrupt;
///     std::vector<Job> jobs{{.name = "soft", .scene = soft, .directory = folder_of_its_file}};
///     const auto results = run_jobs(jobs, {.cache = out / "runs"}, interrupt.requested(),
///     streams); if (!all_ended(results)) { return exit_interrupted; }  // the same call goes on
///     from here io::read_history(results[0].folder / "history.h5");     // or frames, traces, the
///     manifest
///
/// What a run cost stands in its manifest: cycles, seconds of processor time, and by
/// RealisationManifest::step_time() seconds per particle-step.
#pragma once

#include "core/scene.hpp"

#include "io/manifest.hpp"

#include "cli/streams.hpp"

#include <atomic>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace grainbench::cli {

struct Job {
    std::string name{};                 ///< for messages
    Scene scene{};                      ///< read, patched and valid: see io::read_scene
    std::filesystem::path directory{};  ///< that file names in the scene are relative to
    /// Wanted for its times: such jobs run after all others, one realisation at a time, with the
    /// machine for themselves.
    bool timed = false;
};

struct JobResult {
    std::filesystem::path folder{};  ///< run folder
    /// Its outcome is "finished", "unstable" (which is a result, too: see `message`), or
    /// "interrupted".
    io::Manifest manifest{};
    bool reused = false;  ///< it was there before
};

struct JobOptions {
    std::filesystem::path cache{};  ///< folder of the run folders
    unsigned threads = 0;           ///< 0 = one for each processor
    bool quiet = false;             ///< no talk
};

/// One result for each job, in their order. Jobs with equal scenes share one run. A progress line
/// goes over the whole. Where `stop` becomes true, runs pause at a checkpoint and the results say
/// "interrupted". An error of a scene or of files is thrown, with the name of its job, after the
/// other runs have paused.
std::vector<JobResult> run_jobs(std::span<const Job> jobs,
                                const JobOptions& options,
                                const std::atomic<bool>& stop,
                                const Streams& streams);

/// False if some run was interrupted.
bool all_ended(std::span<const JobResult> results);

}  // namespace grainbench::cli
