/// The folder of one run: everything that `grainbench run` leaves behind, kept so that a run that
/// is killed at any moment can be looked at and goes on from its last checkpoint.
///
///     scene.json  manifest.json  history.h5  [history.csv]  checkpoint.h5  checkpoint-previous.h5
///     realisation-1/  particles.pvd particles_000000.vtu ...  walls.pvd walls_000000.vtp ...
///                     [contacts.pvd contacts_000000.vtp ...]  [fields.pvd fields_000000.vti ...]
///                     traces.vtp
#pragma once

#include "core/archive.hpp"
#include "core/frame.hpp"
#include "core/scene.hpp"
#include "core/simulation.hpp"

#include "io/background.hpp"
#include "io/manifest.hpp"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace grainbench::io {

/// Tells scenes apart: over the effective JSON and what the scene read from other files.
std::string scene_hash(const std::string& scene_json, const Scene& scene);

struct RunFolderOptions {
    bool resume = false;       ///< go on with the run that the folder holds; start anew if none
    bool history_csv = false;  ///< write history.csv as well
};

/// All members may be called from any thread. Realisations count from 0 here, from 1 in names.
class RunFolder {
public:
    /// Makes the folder and writes scene.json. Throws Error(bad_input) if the folder holds a run
    /// and `resume` is off, or holds the checkpoint of another scene. On resuming, what was written
    /// after the checkpoint is taken back, so that the run writes the same files as one that never
    /// stopped.
    RunFolder(std::filesystem::path folder,
              std::string scene_json,
              const Scene& scene,
              std::size_t realisations,
              const RunFolderOptions& options);
    ~RunFolder();
    RunFolder(const RunFolder&) = delete;
    RunFolder& operator=(const RunFolder&) = delete;

    /// Writes what the simulation of this realisation reports, beside the stepping: frames are
    /// taken when they are due and written while the simulation goes on. A failure is thrown when
    /// the next is due, or by drain(). Lives as long as the folder.
    Observer& observer(std::size_t realisation);

    /// State to go on from, for each realisation; empty where it starts at the beginning.
    std::vector<std::optional<Archive>> load_checkpoint() const;

    /// What the user should know about the checkpoint; empty if all is well.
    const std::string& warning() const;

    /// Waits until all that was reported is written. Throws what went wrong meanwhile.
    void drain();

    /// Writes what is still to be written, then the history, the traces and the manifest.
    void finish(const Manifest& manifest);

    // What observers let the background do.

    /// \param contacts null if the contact network is not asked for
    void write_frame(std::size_t realisation,
                     const ParticleFrame& particles,
                     const WallFrame& walls,
                     const ContactFrame* contacts);
    void write_fields(std::size_t realisation, const FieldFrame& fields);
    void append_history(std::size_t realisation,
                        std::span<const HistoryColumn> columns,
                        std::span<const double> row);
    void append_trace(std::size_t realisation, double time, std::span<const TracePoint> points);

    /// Adds its own counts to the archive (keys "output/..."), then writes history and checkpoint.
    void write_checkpoint(std::size_t realisation, Archive archive);

    /// True if the scene asks for the contact network in this stage.
    bool wants_contacts(std::size_t stage) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
    std::mutex observers_mutex_;
    std::vector<std::unique_ptr<Observer>> observers_;  ///< made when first asked for
    Background background_;                             ///< last, for its tasks need the rest
};

}  // namespace grainbench::io
