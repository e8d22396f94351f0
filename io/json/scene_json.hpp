/// Between a JSON file and grainbench::Scene: strict reading with `extends` and overrides, writing
/// of the effective scene, and the rules that a scene must keep.
#pragma once

#include "core/scene.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace grainbench::io {

/// Reads a scene file: resolves "extends" (relative to the file, chains allowed; RFC 7386 merge
/// patch), applies overrides "/json/pointer=value", parses strictly, imports files and validates.
/// Throws Error(bad_input) that lists every problem found.
Scene read_scene(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// The same for text.
/// \param base_directory folder that "extends" and imported files are relative to
/// \param name what the text is called in messages
Scene parse_scene(std::string_view json_text,
                  const std::filesystem::path& base_directory,
                  std::string_view name);

/// The effective scene as JSON: defaults filled in, absent options left out; reads back the same to
/// the last bit.
/// \param base_directory folder that file names in the scene are relative to. If given, they are
/// made absolute, so that the text may lie in any folder of this machine; if empty they stay as
/// they are.
std::string write_scene(const Scene& scene, const std::filesystem::path& base_directory = {});

/// Checks domains, names that refer to each other, and combinations. Throws Error(bad_input) that
/// lists every problem found.
void validate_scene(const Scene& scene);

}  // namespace grainbench::io
