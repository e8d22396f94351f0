/// Raw triangles and points of files of other programs, before io/import.hpp checks them.
#pragma once

#include "core/scene.hpp"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace grainbench::io {

/// Triangles of an STL file, text or binary. Error(bad_input) for damaged or empty files.
std::vector<std::array<Vec3, 3>> read_stl_triangles(const std::filesystem::path& path);

/// Triangles of a VTP file; polygons of more corners and strips are cut into triangles.
std::vector<std::array<Vec3, 3>> read_vtp_triangles(const std::filesystem::path& path);

/// Points of a VTP file with the point arrays radius, velocity, angular_velocity and species, as
/// far as they are there. Species are names, or numbers with the field array species_names, as
/// frame_writer.hpp writes them; rows without one have an empty name. Radii must be positive.
std::vector<FileInsertion::Row> read_point_rows(const std::filesystem::path& path);

/// Error(bad_input) unless the radius of an imported sphere is positive.
void check_radius(double radius, const std::string& place);

}  // namespace grainbench::io
