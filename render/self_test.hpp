/// Whether this machine can draw, and with what.
#pragma once

#include <string>

namespace grainbench::render {

/// Draws a sphere and looks at its pixels. Returns what OpenGL calls its renderer and version.
/// Error(input_output) that names the package to install where OSMesa is absent.
std::string test_drawing();

}  // namespace grainbench::render
