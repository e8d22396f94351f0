/// The frames of a run folder in other formats, in another folder.
#pragma once

#include "core/describe.hpp"

#include <array>
#include <cstddef>
#include <filesystem>
#include <string_view>
#include <utility>

namespace grainbench {

namespace io {

/// vtu: the files as they are. vtp: particles as polygonal data, the other files as they are. csv:
/// one table of particles for each frame, and history.csv.
enum class ExportFormat { vtu, vtp, csv };

/// Writes one folder for each realisation; returns the number of files. Throws Error(bad_input) if
/// `run` is no run folder or is the target itself.
std::size_t export_run(const std::filesystem::path& run,
                       const std::filesystem::path& target,
                       ExportFormat format);

}  // namespace io

template <>
struct EnumNames<io::ExportFormat> {
    static constexpr std::array<std::pair<io::ExportFormat, std::string_view>, 3> value{
        {{io::ExportFormat::vtu, "vtu"},
         {io::ExportFormat::vtp, "vtp"},
         {io::ExportFormat::csv, "csv"}}};
};

}  // namespace grainbench
