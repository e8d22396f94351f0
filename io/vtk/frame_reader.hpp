/// Frames back from the VTK files of a run folder: for the renderer, exports and comparisons.
/// A missing or damaged file is an Error(input_output) that names it.
#pragma once

#include "core/frame.hpp"

#include <filesystem>

namespace grainbench::io {

/// Particles of a .vtu file. Numbers have the single precision of the file.
ParticleFrame read_particles_frame(const std::filesystem::path& path);

/// Walls of a .vtp file. A wall keeps the points that its polygons use.
WallFrame read_walls_frame(const std::filesystem::path& path);

}  // namespace grainbench::io
