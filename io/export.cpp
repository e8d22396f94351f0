#include "io/export.hpp"

#include "core/error.hpp"
#include "core/frame.hpp"

#include "io/atomic_file.hpp"
#include "io/hdf5/history.hpp"
#include "io/text.hpp"
#include "io/vtk/frame_reader.hpp"
#include "io/vtk/frame_writer.hpp"
#include "io/vtk/pvd.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace grainbench::io {
namespace {

/// Folders realisation-1, realisation-2 ... of a run.
std::vector<std::filesystem::path> realisations_of(const std::filesystem::path& run) {
    std::vector<std::filesystem::path> folders;
    for (std::size_t k = 1;; ++k) {
        std::filesystem::path folder = run / ("realisation-" + std::to_string(k));
        if (!file_exists(folder)) {
            return folders;
        }
        folders.push_back(std::move(folder));
    }
}

void check_folders(const std::filesystem::path& run,
                   const std::filesystem::path& target,
                   bool is_empty) {
    if (is_empty) {
        throw_bad_input({.what = "the folder holds no run",
                         .where = run.string(),
                         .likely_cause = "a typing error, or a file of the run was named",
                         .next_step = "name the folder that 'grainbench run' wrote"});
    }
    std::error_code code;
    if (std::filesystem::equivalent(run, target, code)) {
        throw_bad_input({.what = "a run cannot be exported into its own folder",
                         .where = target.string(),
                         .likely_cause = "-o names the folder of the run",
                         .next_step = "choose another folder with -o"});
    }
}

std::string particle_table(const ParticleFrame& frame) {
    std::string text =
        "id,x,y,z,radius,species,group,layer,current_layer,vx,vy,vz,wx,wy,wz,fx,fy,fz,contacts";
    text += frame.orientation.empty() ? "\n" : ",qw,qx,qy,qz\n";
    for (std::size_t k = 0; k < frame.size(); ++k) {
        const auto number = [&](double value) {
            text += ',';
            text += to_single_text(value);
        };
        const auto vector = [&](const Vec3& v) {
            number(v.x);
            number(v.y);
            number(v.z);
        };
        const auto integer = [&](std::int32_t value) {
            text += ',';
            text += std::to_string(value);
        };
        text += std::to_string(frame.id[k]);
        vector(frame.position[k]);
        number(frame.radius[k]);
        integer(frame.species[k]);
        integer(frame.group[k]);
        integer(frame.layer[k]);
        integer(frame.current_layer[k]);
        vector(frame.velocity[k]);
        vector(frame.angular_velocity[k]);
        vector(frame.force[k]);
        integer(frame.contacts[k]);
        for (std::size_t c = 0; c < 4 && !frame.orientation.empty(); ++c) {
            number(frame.orientation[k][c]);
        }
        text += '\n';
    }
    return text;
}

/// Writes the files of one series anew; returns how many.
/// \param write called with the old and the new path of each frame
template <class Write>
std::size_t export_series(const std::filesystem::path& from,
                          const std::filesystem::path& to,
                          const std::string& name,
                          const std::string& extension,
                          Write write) {
    const std::filesystem::path series = from / (name + ".pvd");
    if (!file_exists(series)) {
        return 0;
    }
    std::vector<PvdEntry> entries = read_pvd(series);
    for (PvdEntry& entry : entries) {
        // Only the name counts: an entry must not lead out of the folder.
        const std::filesystem::path old_name = std::filesystem::path(entry.file).filename();
        std::filesystem::path new_name = old_name;
        new_name.replace_extension(extension);
        write(from / old_name, to / new_name);
        entry.file = new_name.string();
    }
    if (extension != ".csv") {
        write_pvd(to / (name + ".pvd"), entries);
        return entries.size() + 1;
    }
    return entries.size();
}

void copy_whole(const std::filesystem::path& from, const std::filesystem::path& to) {
    write_file(to, read_file(from));
}

std::size_t export_realisation(const std::filesystem::path& from,
                               const std::filesystem::path& to,
                               ExportFormat format) {
    make_folder(to);
    if (format == ExportFormat::csv) {
        return export_series(from, to, "particles", ".csv", [](const auto& old, const auto& now) {
            write_file(now, particle_table(read_particles_frame(old)));
        });
    }
    std::size_t files = format == ExportFormat::vtp
                            ? export_series(from, to, "particles", ".vtp", convert_particles)
                            : export_series(from, to, "particles", ".vtu", copy_whole);
    files += export_series(from, to, "walls", ".vtp", copy_whole);
    files += export_series(from, to, "contacts", ".vtp", copy_whole);
    files += export_series(from, to, "fields", ".vti", copy_whole);
    if (file_exists(from / "traces.vtp")) {
        copy_whole(from / "traces.vtp", to / "traces.vtp");
        ++files;
    }
    return files;
}

}  // namespace

std::size_t export_run(const std::filesystem::path& run,
                       const std::filesystem::path& target,
                       ExportFormat format) {
    const std::vector<std::filesystem::path> realisations = realisations_of(run);
    check_folders(run, target, realisations.empty());
    std::size_t files = 0;
    for (const std::filesystem::path& folder : realisations) {
        files += export_realisation(folder, target / folder.filename(), format);
    }
    if (format == ExportFormat::csv && file_exists(run / "history.h5")) {
        write_history_csv(target / "history.csv", read_history(run / "history.h5"));
        ++files;
    }
    return files;
}

}  // namespace grainbench::io
