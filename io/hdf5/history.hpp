/// history.h5: for each realisation one column of numbers per measured quantity, with its unit and
/// description as attributes, the traced points, and the scene that made them.
#pragma once

#include "io/history.hpp"

#include <filesystem>

namespace grainbench::io {

inline constexpr const char* history_format = "grainbench-history/1";

/// Replaces the file as a whole; the same history gives the same bytes.
void write_history(const std::filesystem::path& path, const History& history);

/// Error(input_output) that names the file if it is missing or damaged.
History read_history(const std::filesystem::path& path);

/// One table for spreadsheets: the column `realisation` (from 1), then those of the history.
void write_history_csv(const std::filesystem::path& path, const History& history);

}  // namespace grainbench::io
