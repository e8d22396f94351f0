/// checkpoint.h5: the state of all realisations to the bit, from which a run goes on. The file
/// before the newest stays as checkpoint-previous.h5 and steps in if the newest is damaged; a sum
/// over the bytes, in front of the HDF5 data, tells.
#pragma once

#include "core/archive.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace grainbench::io {

inline constexpr const char* checkpoint_format = "grainbench-checkpoint/1";

struct Checkpoint {
    std::string scene_hash;
    std::vector<std::optional<Archive>> realisations;  ///< empty where none was saved yet
};

/// "checkpoint.h5" -> "checkpoint-previous.h5", in the same folder.
std::filesystem::path previous_checkpoint(const std::filesystem::path& path);

/// Replaces the file as a whole and keeps the old one as previous. Takes apart what it is given, so
/// that a state is in memory once and a half and not twice.
void write_checkpoint(const std::filesystem::path& path, Checkpoint checkpoint);

/// The newest checkpoint that can be read; nothing if there is none. Error(bad_input) if it belongs
/// to another scene, Error(input_output) if neither file can be read.
/// \param warning is set if the previous checkpoint had to step in, and says why
std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& path,
                                          const std::string& scene_hash,
                                          std::string& warning);

}  // namespace grainbench::io
