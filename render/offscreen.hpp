/// A window without display, GPU or X server, for VTK to draw in: Debian's VTK on OSMesa.
/// Internal to render: shows VTK.
///
/// The recipe, each step of which is needed:
/// - the OpenGL context exists and is current before VTK sees the window;
/// - the functions of gl_entry_points.cpp stand in for libGL and GLX;
/// - vtkGenericOpenGLRenderWindow adopts the current context, and an observer tells it that the
///   context is current whenever it asks.
/// VTK draws into framebuffer objects of its own, so the buffer that OSMesa insists on is one
/// pixel.
///
/// Draw while holding an io::VtkSession, as for every use of VTK. A context belongs to the thread
/// that made it. Keep one Offscreen for many pictures: making one takes tens of milliseconds.
#pragma once

#include "render/image.hpp"

#include <memory>
#include <string>

class vtkRenderWindow;

namespace grainbench::render {

class Offscreen {
public:
    /// Error(input_output) if OSMesa cannot be loaded.
    Offscreen();
    ~Offscreen();
    Offscreen(const Offscreen&) = delete;
    Offscreen& operator=(const Offscreen&) = delete;

    /// To add renderers to. Its size is set by draw().
    vtkRenderWindow* window() const;

    /// Renders what the window holds and reads the pixels.
    Image draw(ImageSize size);

    /// What OpenGL calls its renderer and version: "llvmpipe (LLVM 15.0.6, 256 bits), 3.2 ...".
    const std::string& gl_renderer() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace grainbench::render
