/// Spheres and triangles that a scene takes from other files. io/json calls these while it reads a
/// scene, so that a Scene is complete once it is in memory.
#pragma once

#include "core/scene.hpp"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace grainbench::io {

/// Spheres of a CSV or VTP file, chosen by its extension; rows that name no species get the
/// default.
std::vector<FileInsertion::Row> read_particles(const std::filesystem::path& file,
                                               const std::string& default_species);

/// Triangles of an STL or VTP file, chosen by its extension.
/// \param scale [m] length of one unit of the file
void read_mesh(const std::filesystem::path& file,
               double scale,
               std::vector<Vec3>& vertices,
               std::vector<std::array<Index, 3>>& triangles);

}  // namespace grainbench::io
