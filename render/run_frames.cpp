#include "render/run_frames.hpp"

#include "core/error.hpp"

#include "io/atomic_file.hpp"
#include "io/vtk/pvd.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace grainbench::render {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const fs::path& run, std::int64_t number) {
    return run / fmt::format("realisation-{}", number);
}

[[noreturn]] void throw_no_run(const fs::path& folder) {
    throw_bad_input({.what = "this is no run folder: it holds no realisation-1/particles.pvd",
                     .where = folder.string(),
                     .likely_cause = "a slip in the path, or a run that wrote no frame",
                     .next_step = "hand in the folder that `grainbench run` wrote"});
}

std::vector<std::int64_t> all_realisations(const fs::path& folder) {
    std::vector<std::int64_t> numbers;
    for (std::int64_t n = 1; io::file_exists(folder_of(folder, n) / "particles.pvd"); ++n) {
        numbers.push_back(n);
    }
    return numbers;
}

std::vector<std::string> files_of(const std::vector<io::PvdEntry>& entries) {
    std::vector<std::string> files;
    for (const io::PvdEntry& entry : entries) {
        files.push_back(entry.file);
    }
    return files;
}

}  // namespace

RunFrames::RunFrames(fs::path folder, std::vector<std::int64_t> realisations)
    : folder_(std::move(folder)) {
    const std::vector<std::int64_t> all = all_realisations(folder_);
    if (all.empty()) {
        throw_no_run(folder_);
    }
    for (const std::int64_t number : realisations.empty() ? all : realisations) {
        if (std::find(all.begin(), all.end(), number) == all.end()) {
            throw_bad_input({.what = fmt::format("the run has no realisation {}", number),
                             .where = folder_.string(),
                             .likely_cause = fmt::format("it has {} of them", all.size()),
                             .next_step = "change 'realisations' of the look"});
        }
        const fs::path place = folder_of(folder_, number);
        const std::vector<io::PvdEntry> particles = io::read_pvd(place / "particles.pvd");
        const std::vector<io::PvdEntry> walls = io::read_pvd(place / "walls.pvd");
        const std::size_t count = std::min(particles.size(), walls.size());
        if (files_.empty()) {
            for (const io::PvdEntry& entry : particles) {
                times_.push_back(entry.time);
            }
        }
        times_.resize(std::min(times_.size(), count));
        files_.push_back({number, place, files_of(particles), files_of(walls)});
    }
    if (times_.empty()) {
        throw_no_run(folder_);
    }
    read_scene();
}

/// Only names are taken, so that a run can be drawn whose meshes are gone.
void RunFrames::read_scene() {
    const fs::path file = folder_ / "scene.json";
    try {
        const auto scene = nlohmann::json::parse(io::read_file(file));
        has_layers_ = scene.contains("layers");
        for (const auto& group : scene.value("groups", nlohmann::json::array())) {
            group_names_.push_back(group.at("name").get<std::string>());
        }
    } catch (const nlohmann::json::exception& failure) {
        throw_input_output({.what = fmt::format("cannot read a scene: {}", failure.what()),
                            .where = file.string(),
                            .likely_cause = "the file is damaged",
                            .next_step = "run the scene again"});
    }
}

std::size_t RunFrames::nearest(double time) const {
    const auto distance = [&](double of_frame) { return std::abs(of_frame - time); };
    const auto best = std::min_element(times_.begin(), times_.end(), [&](double a, double b) {
        return distance(a) < distance(b);
    });
    const double first = times_.front();
    const double last = times_.back();
    if (std::isinf(time)) {
        return time < 0.0 ? 0 : times_.size() - 1;
    }
    const double interval =
        times_.size() > 1 ? (last - first) / static_cast<double>(times_.size() - 1) : 0.0;
    if (distance(*best) > interval + 1e-9 * std::abs(time)) {
        throw_bad_input(
            {.what = fmt::format("the run has no frame near t = {} s", time),
             .where = folder_.string(),
             .likely_cause = fmt::format(
                 "its {} frames reach from {:.6g} s to {:.6g} s", times_.size(), first, last),
             .next_step = "ask for a time in this range"});
    }
    return static_cast<std::size_t>(best - times_.begin());
}

Instant RunFrames::read(std::size_t frame) const {
    Instant instant{.time = times_.at(frame), .realisations = {}};
    for (const Files& files : files_) {
        instant.realisations.push_back(
            {.number = files.number,
             .particles = io::read_particles_file(files.folder / files.particles.at(frame)),
             .walls = io::read_walls_frame(files.folder / files.walls.at(frame))});
    }
    return instant;
}

std::vector<io::TraceTable> RunFrames::read_traces() const {
    std::vector<io::TraceTable> traces;
    for (const Files& files : files_) {
        const fs::path file = files.folder / "traces.vtp";
        if (!io::file_exists(file)) {
            throw_bad_input({.what = "the run has no traces to draw",
                             .where = file.string(),
                             .likely_cause = "the run is not finished",
                             .next_step = "let it finish, or take 'traces' out of the look"});
        }
        traces.push_back(io::read_traces(file));
    }
    return traces;
}

}  // namespace grainbench::render
