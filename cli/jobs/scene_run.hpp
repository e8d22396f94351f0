/// One scene on its way into a run folder: what `grainbench run` and the job pool (job_pool.hpp)
/// share. Who steps the realisations, and in what order, is up to the caller; this class opens the
/// folder, takes realisations back to their checkpoints, writes what they report, and keeps what
/// each of them was and cost for the manifest.
#pragma once

#include "core/ensemble.hpp"
#include "core/scene.hpp"
#include "core/simulation.hpp"

#include "io/manifest.hpp"
#include "io/run_folder.hpp"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace grainbench::cli {

/// Cycles between two looks at the clock and at signals: a hundredth of a second or so.
std::uint64_t slice_for(std::size_t particles);

/// Realisations count from 0. `resume`, `observer` and `keep` may be called from any thread, for
/// different realisations at the same time.
class SceneRun {
public:
    /// Makes the folder; its errors are those of io::RunFolder. Build a realisation first, so that
    /// a scene that cannot be built leaves no folder behind.
    /// \param directory that file names in the scene are relative to
    SceneRun(Scene scene,
             const std::filesystem::path& directory,
             std::filesystem::path folder,
             const io::RunFolderOptions& options);
    ~SceneRun();
    SceneRun(const SceneRun&) = delete;
    SceneRun& operator=(const SceneRun&) = delete;

    const Scene& scene() const { return scene_; }

    const std::filesystem::path& folder() const { return path_; }

    /// What the user should know about the checkpoint; empty if all is well.
    const std::string& warning() const { return folder_.warning(); }

    /// Takes the realisation to where the folder's checkpoint left it. False if it has none.
    bool resume(Simulation& simulation);

    /// Writes what the realisation reports, and measures what writing takes.
    Observer& observer(std::size_t realisation);

    /// Keeps what the manifest says of a realisation that has finished or was paused; a paused one
    /// gets a checkpoint.
    void keep(const Simulation& simulation, const RealisationCost& cost);

    /// The same for one that a guard stopped: the state in which it stopped becomes a frame, for
    /// looking, and the checkpoint stays the last good one.
    void keep_unstable(const Simulation& simulation,
                       const RealisationCost& cost,
                       const Error& error);

    /// Fraction of the stepping time that went into writing [1].
    double output_share() const;

    /// Writes history, traces and manifest. "interrupted" unless every realisation was kept
    /// finished or unstable; "unstable" if one was.
    /// \param threads that stepped, for the manifest
    io::Manifest finish(unsigned threads);

private:
    class TimedObserver;

    /// What is known of one realisation.
    struct Part {
        std::uint64_t first_cycle = 0;                ///< of this call
        std::optional<io::RealisationManifest> said;  ///< none before keep()
        bool finished = false;
        bool unstable = false;
    };

    void describe(const Simulation& simulation, const RealisationCost& cost);

    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    Scene scene_;
    std::filesystem::path path_;
    std::optional<io::Manifest> before_;  ///< of the run that this one goes on with
    io::RunFolder folder_;
    mutable std::mutex mutex_;
    std::vector<std::unique_ptr<TimedObserver>> observers_;
    std::vector<Part> parts_;
    std::string isa_;
    std::string message_;
};

}  // namespace grainbench::cli
