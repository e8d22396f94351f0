/// Pictures of the particles of a run: (run folder, look, frame) to a PNG file. Frames of one run
/// share one camera and one OpenGL context, so draw them with one object.
#pragma once

#include "render/image.hpp"
#include "render/look.hpp"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace grainbench::render {

struct Snapshot {
    Image image;
    ImageText text;  ///< program, scene, seeds, time, look and OpenGL renderer
};

class SnapshotPainter {
public:
    /// Error(bad_input) if `run` is no run folder or the look does not fit it, Error(input_output)
    /// if a file is damaged or OSMesa is absent.
    /// \param program name and version, for the text in the file
    SnapshotPainter(const std::filesystem::path& run, Look look, std::string program);
    ~SnapshotPainter();
    SnapshotPainter(const SnapshotPainter&) = delete;
    SnapshotPainter& operator=(const SnapshotPainter&) = delete;

    /// Times of the frames of the run.
    const std::vector<double>& times() const;

    /// The frame nearest to a time; minus and plus infinity give the first and the last.
    std::size_t nearest(double time) const;

    /// The same frame of the same run always gives the same picture.
    Snapshot draw(std::size_t frame);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// True if the scene of a run folder numbers layers.
bool run_has_layers(const std::filesystem::path& run);

/// Draws the frame nearest to `time` and writes it. For more than one frame use SnapshotPainter.
void write_snapshot(const std::filesystem::path& run,
                    const Look& look,
                    double time,
                    const std::filesystem::path& png,
                    const std::string& program);

}  // namespace grainbench::render
