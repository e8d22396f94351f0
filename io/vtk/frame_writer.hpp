/// Frames as VTK files for ParaView and for our own renderer: XML, raw appended data, light
/// compression, sorted as the frame is. The same frame gives the same bytes, and a frame without
/// particles, contacts or traces gives a valid file.
#pragma once

#include "core/frame.hpp"

#include "io/history.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace grainbench::io {

/// Where a file comes from; written into its field data.
struct Provenance {
    std::string program;  ///< name and version
    std::string scene_title;
    std::string scene_hash;
    std::int64_t seed = 0;
    std::vector<std::string> species_names;  ///< what the numbers of the array species stand for
};

/// Spheres as vertex cells with the point arrays id, radius, diameter, species, group, layer,
/// current_layer, velocity, angular_velocity, force, contacts, and orientation where the frame has
/// it. The name ends in .vtu, or in .vtp for programs that want polygonal data.
void write_particles(const std::filesystem::path& path,
                     const ParticleFrame& frame,
                     const Provenance& provenance);

/// Walls as polygons (.vtp) with the cell arrays wall (1 + index, as in contact files), velocity
/// and force; the field array wall_names lists the names.
void write_walls(const std::filesystem::path& path,
                 const WallFrame& frame,
                 const Provenance& provenance);

/// Contacts as lines (.vtp) with the cell arrays overlap, force_normal, force_tangential, i_id,
/// j_id, wall, force, branch, point, i_species and j_species.
void write_contacts(const std::filesystem::path& path,
                    const ContactFrame& frame,
                    const Provenance& provenance);

/// Fields as image data (.vti) with the cell arrays density, solid_fraction, velocity,
/// granular_temperature, pressure, contact_stress and kinetic_stress.
void write_fields(const std::filesystem::path& path,
                  const FieldFrame& frame,
                  const Provenance& provenance);

/// One polyline (.vtp) for each traced particle, ordered by id, with the point arrays time,
/// velocity and id.
void write_traces(const std::filesystem::path& path,
                  const TraceTable& traces,
                  const Provenance& provenance);

/// Writes particles that write_particles wrote as .vtu again as .vtp, provenance included.
void convert_particles(const std::filesystem::path& vtu, const std::filesystem::path& vtp);

}  // namespace grainbench::io
