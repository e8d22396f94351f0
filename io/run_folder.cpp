#include "io/run_folder.hpp"

#include "core/error.hpp"
#include "core/version.hpp"

#include "io/atomic_file.hpp"
#include "io/frame_series.hpp"
#include "io/hdf5/checkpoint.hpp"
#include "io/hdf5/history.hpp"
#include "io/text.hpp"
#include "io/vtk/frame_writer.hpp"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <utility>

namespace grainbench::io {
namespace {

// Archive keys of our own: how much output belongs to a checkpoint.
constexpr const char* frames_key = "output/frames";
constexpr const char* fields_key = "output/fields";  // only where the scene asks for fields
constexpr const char* rows_key = "output/history_rows";
constexpr const char* trace_key = "output/trace_points";

constexpr const char* run_files[] = {
    "scene.json", "manifest.json", "history.h5", "checkpoint.h5", "checkpoint-previous.h5"};

std::string program_name() {
    return std::string("grainbench ") + version;
}

bool holds_run(const std::filesystem::path& folder) {
    return std::any_of(std::begin(run_files),
                       std::end(run_files),
                       [&](const char* name) { return file_exists(folder / name); }) ||
           file_exists(folder / "realisation-1");
}

void hash_numbers(std::uint64_t& hash, const Vec3& v) {
    hash = fnv1a(to_text(v.x) + " " + to_text(v.y) + " " + to_text(v.z) + " ", hash);
}

/// A write that was cut short may have left its temporary file.
void remove_temporary_files(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() == ".tmp") {
            found.push_back(entry.path());
        }
    }
    for (const std::filesystem::path& path : found) {
        remove_file(path);
    }
}

}  // namespace

std::string scene_hash(const std::string& scene_json, const Scene& scene) {
    std::uint64_t hash = fnv1a(scene_json);
    for (const Insertion& insertion : scene.particles.insertion) {
        if (const auto* file = std::get_if<FileInsertion>(&insertion)) {
            for (const FileInsertion::Row& row : file->imported) {
                hash = fnv1a(row.species + " " + to_text(row.radius) + " ", hash);
                hash_numbers(hash, row.position);
                hash_numbers(hash, row.velocity);
                hash_numbers(hash, row.angular_velocity);
            }
        }
    }
    for (const Wall& wall : scene.walls) {
        if (const auto* mesh = std::get_if<MeshFile>(&wall.shape)) {
            for (const std::array<Index, 3>& triangle : mesh->triangles) {
                for (const Index corner : triangle) {
                    hash_numbers(hash, mesh->vertices.at(corner));
                }
            }
        }
    }
    return to_hex(hash);
}

struct RunFolder::Impl {
    /// Output of one realisation.
    struct Realisation {
        explicit Realisation(const std::filesystem::path& folder)
            : particles(folder, "particles", ".vtu"),
              walls(folder, "walls", ".vtp"),
              contacts(folder, "contacts", ".vtp"),
              fields(folder, "fields", ".vti"),
              traces_file(folder / "traces.vtp") {}

        FrameSeries particles;
        FrameSeries walls;
        FrameSeries contacts;
        FrameSeries fields;
        std::filesystem::path traces_file;
        std::size_t frames = 0;
        std::size_t field_frames = 0;
        Provenance provenance;
    };

    std::mutex mutex;
    std::filesystem::path folder;
    RunFolderOptions options;
    std::vector<bool> wants_contacts;  ///< of each stage
    bool wants_fields = false;
    std::vector<Realisation> realisations;
    History history;
    Checkpoint checkpoint;
    std::string warning;
    std::chrono::steady_clock::time_point next_flush;

    std::filesystem::path history_file() const { return folder / "history.h5"; }

    std::filesystem::path checkpoint_file() const { return folder / "checkpoint.h5"; }

    std::filesystem::path folder_of(std::size_t realisation) const {
        return folder / ("realisation-" + std::to_string(realisation + 1));
    }

    /// The file is written as a whole each time, so the pause grows with what a write takes: a
    /// killed run loses some seconds of its history, and writing costs at most a twentieth.
    void flush_history() {
        const auto start = std::chrono::steady_clock::now();
        write_history(history_file(), history);
        const auto end = std::chrono::steady_clock::now();
        next_flush = end + std::max<std::chrono::steady_clock::duration>(std::chrono::seconds(10),
                                                                         20 * (end - start));
    }

    void describe(const Scene& scene, std::size_t count) {
        for (const Stage& stage : scene.stages) {
            wants_contacts.push_back(stage.output ? stage.output->contacts : scene.output.contacts);
        }
        wants_fields = scene.observables.coarse_graining.has_value();
        Provenance provenance{.program = history.program,
                              .scene_title = scene.title,
                              .scene_hash = history.scene_hash,
                              .seed = 0,
                              .species_names = {}};
        for (const Species& species : scene.particles.species) {
            provenance.species_names.push_back(species.name);
        }
        for (std::size_t k = 0; k < count; ++k) {
            provenance.seed = scene.realisations.seed + static_cast<std::int64_t>(k);
            realisations.emplace_back(folder_of(k));
            realisations.back().provenance = provenance;
            history.realisations.push_back({.seed = provenance.seed, .history = {}, .traces = {}});
        }
        checkpoint.scene_hash = history.scene_hash;
        checkpoint.realisations.resize(count);
    }

    /// Takes the folder back to its checkpoint, or to the beginning if it has none.
    void resume() {
        std::optional<Checkpoint> found =
            read_checkpoint(checkpoint_file(), history.scene_hash, warning);
        if (found) {
            // The hash covers the number of realisations.
            found->realisations.resize(realisations.size());
            checkpoint = std::move(*found);
            resume_history();
        } else if (file_exists(folder / "scene.json") &&
                   read_file(folder / "scene.json") != history.scene) {
            throw_bad_input({.what = "the folder holds a run of another scene",
                             .where = folder.string(),
                             .likely_cause = "the scene changed since the run began",
                             .next_step = "resume with the scene.json of that folder, or choose "
                                          "another folder with -o"});
        }
        remove_file(folder / "manifest.json");
        remove_temporary_files(folder);
        for (std::size_t k = 0; k < realisations.size(); ++k) {
            if (!file_exists(folder_of(k))) {
                continue;
            }
            remove_temporary_files(folder_of(k));
            Realisation& realisation = realisations[k];
            const std::optional<Archive>& archive = checkpoint.realisations[k];
            realisation.frames = archive ? static_cast<std::size_t>(archive->count(frames_key)) : 0;
            realisation.particles.resume(realisation.frames);
            realisation.walls.resume(realisation.frames);
            realisation.contacts.resume(realisation.frames);
            if (archive && wants_fields) {
                realisation.field_frames = static_cast<std::size_t>(archive->count(fields_key));
            }
            realisation.fields.resume(realisation.field_frames);
        }
    }

    void resume_history() {
        const History before = read_history(history_file());
        for (std::size_t k = 0; k < realisations.size(); ++k) {
            const std::optional<Archive>& archive = checkpoint.realisations[k];
            if (!archive || k >= before.realisations.size()) {
                continue;
            }
            RealisationHistory& target = history.realisations[k];
            target = before.realisations[k];
            target.history.truncate(static_cast<std::size_t>(archive->count(rows_key)));
            target.traces.truncate(static_cast<std::size_t>(archive->count(trace_key)));
        }
        for (std::size_t k = 0; k < realisations.size(); ++k) {
            const std::optional<Archive>& archive = checkpoint.realisations[k];
            const RealisationHistory& target = history.realisations[k];
            if (archive && (target.history.rows() != archive->count(rows_key) ||
                            target.traces.points.size() != archive->count(trace_key))) {
                throw_input_output({.what = "the history ends before the checkpoint",
                                    .where = history_file().string(),
                                    .likely_cause = "the file was replaced by an older one",
                                    .next_step = "run the scene again without --resume"});
            }
        }
    }
};

RunFolder::RunFolder(std::filesystem::path folder,
                     std::string scene_json,
                     const Scene& scene,
                     std::size_t realisations,
                     const RunFolderOptions& options)
    : impl_(std::make_unique<Impl>()), observers_(realisations) {
    if (holds_run(folder) && !options.resume) {
        throw_bad_input({.what = "the folder holds a run already",
                         .where = folder.string(),
                         .likely_cause = "the same command ran before",
                         .next_step = "go on with that run by --resume, or choose another folder "
                                      "with -o"});
    }
    impl_->folder = std::move(folder);
    impl_->options = options;
    impl_->history.program = program_name();
    impl_->history.scene_hash = scene_hash(scene_json, scene);
    impl_->history.scene = std::move(scene_json);
    impl_->describe(scene, realisations);
    make_folder(impl_->folder);
    if (options.resume) {
        impl_->resume();
    }
    write_file(impl_->folder / "scene.json", impl_->history.scene);
    for (std::size_t k = 0; k < realisations; ++k) {
        make_folder(impl_->folder_of(k));
    }
    impl_->flush_history();
}

RunFolder::~RunFolder() = default;

std::vector<std::optional<Archive>> RunFolder::load_checkpoint() const {
    const std::scoped_lock lock(impl_->mutex);
    return impl_->checkpoint.realisations;
}

const std::string& RunFolder::warning() const {
    return impl_->warning;
}

void RunFolder::drain() {
    background_.drain();
}

void RunFolder::finish(const Manifest& manifest) {
    drain();
    const std::scoped_lock lock(impl_->mutex);
    impl_->flush_history();
    for (std::size_t k = 0; k < impl_->realisations.size(); ++k) {
        write_traces(impl_->realisations[k].traces_file,
                     impl_->history.realisations[k].traces,
                     impl_->realisations[k].provenance);
    }
    if (impl_->options.history_csv) {
        write_history_csv(impl_->folder / "history.csv", impl_->history);
    }
    write_file(impl_->folder / "manifest.json", to_json(manifest));
}

void RunFolder::write_frame(std::size_t realisation,
                            const ParticleFrame& particles,
                            const WallFrame& walls,
                            const ContactFrame* contacts) {
    const std::scoped_lock lock(impl_->mutex);
    Impl::Realisation& target = impl_->realisations.at(realisation);
    const std::size_t frame = target.frames;
    write_particles(target.particles.path_of(frame), particles, target.provenance);
    target.particles.add(frame, particles.time);
    write_walls(target.walls.path_of(frame), walls, target.provenance);
    target.walls.add(frame, walls.time);
    if (contacts != nullptr) {
        write_contacts(target.contacts.path_of(frame), *contacts, target.provenance);
        target.contacts.add(frame, contacts->time);
    }
    target.frames = frame + 1;
}

void RunFolder::write_fields(std::size_t realisation, const FieldFrame& fields) {
    const std::scoped_lock lock(impl_->mutex);
    Impl::Realisation& target = impl_->realisations.at(realisation);
    const std::size_t frame = target.field_frames;
    io::write_fields(target.fields.path_of(frame), fields, target.provenance);
    target.fields.add(frame, fields.time);
    target.field_frames = frame + 1;
}

void RunFolder::append_history(std::size_t realisation,
                               std::span<const HistoryColumn> columns,
                               std::span<const double> row) {
    const std::scoped_lock lock(impl_->mutex);
    impl_->history.realisations.at(realisation).history.append(columns, row);
    if (std::chrono::steady_clock::now() >= impl_->next_flush) {
        impl_->flush_history();
    }
}

void RunFolder::append_trace(std::size_t realisation,
                             double time,
                             std::span<const TracePoint> points) {
    const std::scoped_lock lock(impl_->mutex);
    impl_->history.realisations.at(realisation).traces.append(time, points);
}

void RunFolder::write_checkpoint(std::size_t realisation, Archive archive) {
    const std::scoped_lock lock(impl_->mutex);
    const RealisationHistory& history = impl_->history.realisations.at(realisation);
    archive.put(frames_key, std::uint64_t{impl_->realisations[realisation].frames});
    if (impl_->wants_fields) {
        archive.put(fields_key, std::uint64_t{impl_->realisations[realisation].field_frames});
    }
    archive.put(rows_key, std::uint64_t{history.history.rows()});
    archive.put(trace_key, std::uint64_t{history.traces.points.size()});
    impl_->checkpoint.realisations[realisation] = std::move(archive);
    // In this order: a history may be ahead of its checkpoint, but never behind it.
    impl_->flush_history();
    // Each file holds all realisations; where there is one alone, its state need not be kept.
    std::vector<std::optional<Archive>>& states = impl_->checkpoint.realisations;
    Checkpoint written{.scene_hash = impl_->checkpoint.scene_hash, .realisations = {}};
    written.realisations =
        states.size() > 1 ? states : std::exchange(states, std::vector<std::optional<Archive>>(1));
    io::write_checkpoint(impl_->checkpoint_file(), std::move(written));
}

bool RunFolder::wants_contacts(std::size_t stage) const {
    return stage < impl_->wants_contacts.size() && impl_->wants_contacts[stage];
}

}  // namespace grainbench::io
