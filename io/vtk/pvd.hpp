/// A .pvd file: the list of the frames of a series with their times. Rewritten whole after each
/// frame, so that ParaView can open a run that is still going on.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace grainbench::io {

struct PvdEntry {
    double time = 0.0;  ///< [s]
    std::string file;   ///< relative to the folder of the .pvd
};

void write_pvd(const std::filesystem::path& path, const std::vector<PvdEntry>& entries);

/// Error(input_output) that names the file if it is missing or damaged.
std::vector<PvdEntry> read_pvd(const std::filesystem::path& path);

}  // namespace grainbench::io
