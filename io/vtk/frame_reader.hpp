/// Frames back from the VTK files of a run folder: for the renderer, exports and comparisons.
/// A missing or damaged file is an Error(input_output) that names it.
#pragma once

#include "core/frame.hpp"

#include "io/history.hpp"
#include "io/vtk/frame_writer.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace grainbench::io {

/// Particles of a .vtu file. Numbers have the single precision of the file.
ParticleFrame read_particles_frame(const std::filesystem::path& path);

/// One point array of a file: `components` numbers for each point.
struct PointArray {
    std::string name;
    std::size_t components = 1;
    std::vector<double> values;
};

/// A .vtu file with all its point arrays, those that are no column of a frame too.
struct ParticleFile {
    ParticleFrame frame;
    Provenance provenance;
    std::vector<PointArray> arrays;
};

ParticleFile read_particles_file(const std::filesystem::path& path);

/// Traces of a .vtp file, ordered by particle, then by time.
TraceTable read_traces(const std::filesystem::path& path);

/// Walls of a .vtp file. A wall keeps the points that its polygons use.
WallFrame read_walls_frame(const std::filesystem::path& path);

}  // namespace grainbench::io
