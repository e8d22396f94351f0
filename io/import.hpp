/// Particles and meshes from files of other programs, ready for a scene.
#pragma once

#include "core/scene.hpp"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace grainbench::io {

/// Spheres from a CSV file (header line; x,y,z required; radius, vx,vy,vz, wx,wy,wz, species
/// optional) or a VTP file (points; point arrays radius, velocity, angular_velocity, species
/// optional). Rows that name no species get `default_species`; rows without a radius keep 0.
std::vector<FileInsertion::Row> read_particles(const std::filesystem::path& path,
                                               const std::string& default_species);

/// Triangles from an STL (text or binary) or VTP file, all lengths times `scale`. Points with the
/// same coordinates become one vertex; triangles without area are refused by number.
void read_mesh(const std::filesystem::path& path,
               double scale,
               std::vector<Vec3>& vertices,
               std::vector<std::array<Index, 3>>& triangles);

}  // namespace grainbench::io
