/// Whole files, all or nothing. A reader, or a run that is killed, sees the old file or the new one
/// and never half of either; whatever goes wrong says which file, why, and what to do.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>

namespace grainbench::io {

/// Writes to a temporary name beside `path`, brings it to the disk and renames it. On failure the
/// temporary file is removed, the old file stays, and Error(input_output) is thrown.
/// \param previous if not empty, an old file at `path` is kept under this name (same folder)
void write_file(const std::filesystem::path& path,
                std::string_view bytes,
                const std::filesystem::path& previous = {});

/// The same of bytes that lie in several places, one behind the other.
void write_file(const std::filesystem::path& path,
                std::initializer_list<std::string_view> pieces,
                const std::filesystem::path& previous = {});

/// Content of a file; Error(input_output) if it cannot be read.
std::string read_file(const std::filesystem::path& path);

/// False also where looking is not permitted; reading then says why.
bool file_exists(const std::filesystem::path& path);

/// Makes a folder and its parents; one that exists already is fine.
void make_folder(const std::filesystem::path& path);

/// Removes a file; one that does not exist is fine.
void remove_file(const std::filesystem::path& path);

}  // namespace grainbench::io
