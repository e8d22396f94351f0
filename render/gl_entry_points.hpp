/// The OpenGL that VTK calls: OSMesa, loaded when first drawn with, so that a machine without it
/// runs every command that draws nothing. Internal to render.
///
/// Debian's VTK is built for X11 and asks libGL and GLX for OpenGL. gl_entry_points.cpp therefore
/// defines, under the names that VTK and GLEW import, functions that hand each call to OSMesa.
/// The linker option of grainbench::render exports them from the executable, where the dynamic
/// linker looks before it looks into libGL.
#pragma once

#include <GL/osmesa.h>

namespace grainbench::render {

/// Functions of libOSMesa that make a context.
struct OsMesa {
    decltype(&OSMesaCreateContextAttribs) create_context;
    decltype(&OSMesaMakeCurrent) make_current;
    decltype(&OSMesaDestroyContext) destroy_context;
    decltype(&OSMesaGetProcAddress) entry_point;
};

/// Loads the library at the first call. Error(input_output) that names the package if it is absent.
const OsMesa& load_osmesa();

}  // namespace grainbench::render
