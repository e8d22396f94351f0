/// A small study for a user who has only a scene: the knobs that usually matter, turned one at a
/// time, on a run short enough to wait for.
#pragma once

#include "io/study.hpp"

#include <filesystem>

namespace grainbench::cli {

/// Compares softer contacts, longer steps and relaxed detection with the scene as it is. What is
/// compared is the elevation where the scene measures it, else where the particles are in the end.
/// The run is cut so that all of it takes some minutes.
io::Study suggested_study(const std::filesystem::path& scene_file);

}  // namespace grainbench::cli
