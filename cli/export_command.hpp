/// `grainbench export`: the frames of a run folder in another format.
#pragma once

#include "io/export.hpp"

#include "cli/streams.hpp"

#include <filesystem>

namespace grainbench::cli {

struct ExportArguments {
    std::filesystem::path run;
    io::ExportFormat format = io::ExportFormat::vtu;
    std::filesystem::path folder;  ///< empty = <run>-<format>
};

int export_command(const ExportArguments& arguments, const Streams& streams);

}  // namespace grainbench::cli
