/// Frames of a run folder, one instant of all realisations at a time. Internal to render.
#pragma once

#include "core/frame.hpp"

#include "io/history.hpp"
#include "io/vtk/frame_reader.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace grainbench::render {

struct RealisationInstant {
    std::int64_t number = 1;  ///< from 1, as in the name of its folder
    io::ParticleFile particles;
    WallFrame walls;
};

struct Instant {
    double time = 0.0;  ///< [s]
    std::vector<RealisationInstant> realisations;
};

class RunFrames {
public:
    /// \param realisations numbers of those to read; empty = all.
    /// Error(bad_input) if the folder is no run folder or has no such realisation.
    RunFrames(std::filesystem::path folder, std::vector<std::int64_t> realisations);

    /// Times of the frames that all realisations have, so far if the run is still going on.
    const std::vector<double>& times() const { return times_; }

    /// The frame nearest to a time; minus and plus infinity give the first and the last.
    /// Error(bad_input) if the run has no frame within one interval of it.
    std::size_t nearest(double time) const;

    Instant read(std::size_t frame) const;

    /// Paths of each realisation in the order of read(). Error(bad_input) if there are none.
    std::vector<io::TraceTable> read_traces() const;

    /// True if the scene numbers layers.
    bool has_layers() const { return has_layers_; }

    const std::vector<std::string>& group_names() const { return group_names_; }

private:
    struct Files {
        std::int64_t number;
        std::filesystem::path folder;
        std::vector<std::string> particles;
        std::vector<std::string> walls;
    };

    void read_scene();

    std::filesystem::path folder_;
    std::vector<Files> files_;
    std::vector<double> times_;
    std::vector<std::string> group_names_;
    bool has_layers_ = false;
};

}  // namespace grainbench::render
