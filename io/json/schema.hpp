/// What a scene may hold, for editors and for people: both made of the field tables of core, so
/// they cannot differ from what is read.
#pragma once

#include <string>

namespace grainbench::io {

/// JSON Schema (draft-07) of a scene file. A file with "extends" needs no required keys and may
/// hold null.
std::string scene_schema();

/// Markdown page with one table for each object of a scene.
std::string scene_reference();

}  // namespace grainbench::io
