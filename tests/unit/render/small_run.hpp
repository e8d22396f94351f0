/// A run folder made by hand: two realisations of a few spheres of two species in a box, with
/// layers, groups and traces, at t = 0, 0.1 and 0.2 s. The same bytes on every machine.
#pragma once

#include "core/frame.hpp"

#include <filesystem>

namespace grainbench {

/// \param particles of each realisation; 0 gives a run without any
void write_small_run(const std::filesystem::path& folder, std::size_t particles = 60);

}  // namespace grainbench
