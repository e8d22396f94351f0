/// Looks as JSON files, and what such a file may hold.
#pragma once

#include "render/look.hpp"

#include <filesystem>
#include <span>
#include <string>

namespace grainbench::render {

/// Reads a look: resolves "extends", applies overrides "/json/pointer=value", parses strictly and
/// checks. "run" becomes relative to the working folder. Throws Error(bad_input) that lists every
/// problem found.
Look read_look(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// The look of `grainbench render` where none is named: all particles by layer or species in
/// translucent walls, with legend, time and scale.
/// \param has_layers true if the run numbers layers
Look default_look(bool has_layers, std::span<const std::string> overrides = {});

/// JSON Schema (draft-07) of a look file.
std::string look_schema();

/// Markdown page with one table for each object of a look.
std::string look_reference();

}  // namespace grainbench::render
