#include "render/offscreen.hpp"

#include "render/gl_entry_points.hpp"

#include <GL/gl.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkUnsignedCharArray.h>

#include <array>
#include <cstring>
#include <stdexcept>

namespace grainbench::render {
namespace {

/// An OSMesa context, current in the thread that made it.
class Context {
public:
    Context() {
        // VTK needs the core profile, depth for hidden surfaces and 3.2 for its impostors.
        constexpr std::array attributes{OSMESA_FORMAT,
                                        OSMESA_RGBA,
                                        OSMESA_DEPTH_BITS,
                                        24,
                                        OSMESA_STENCIL_BITS,
                                        8,
                                        OSMESA_PROFILE,
                                        OSMESA_CORE_PROFILE,
                                        OSMESA_CONTEXT_MAJOR_VERSION,
                                        3,
                                        OSMESA_CONTEXT_MINOR_VERSION,
                                        2,
                                        0};
        context_ = osmesa_.create_context(attributes.data(), nullptr);
        if (context_ == nullptr) {
            throw std::runtime_error("OSMesa makes no OpenGL 3.2 context");
        }
        make_current();
    }

    ~Context() { osmesa_.destroy_context(context_); }

    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    void make_current() {
        if (osmesa_.make_current(context_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1) == GL_FALSE) {
            throw std::runtime_error("OSMesa does not make its context current");
        }
    }

private:
    const OsMesa& osmesa_ = load_osmesa();
    OSMesaContext context_ = nullptr;
    std::array<std::uint8_t, 4> pixel_{};
};

std::string text_of(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text == nullptr ? "unknown" : reinterpret_cast<const char*>(text);
}

void answer_true(vtkObject* /*caller*/, unsigned long /*event*/, void* /*data*/, void* answer) {
    *static_cast<bool*>(answer) = true;
}

}  // namespace

struct Offscreen::Impl {
    Context context;  ///< first, so that it outlives the window
    std::string gl_renderer;
    vtkNew<vtkCallbackCommand> is_current;
    vtkNew<vtkGenericOpenGLRenderWindow> window;
};

Offscreen::Offscreen() : impl_(std::make_unique<Impl>()) {
    impl_->gl_renderer = text_of(GL_RENDERER) + ", OpenGL " + text_of(GL_VERSION);
    vtkGenericOpenGLRenderWindow* window = impl_->window;
    impl_->is_current->SetCallback(answer_true);
    window->AddObserver(vtkCommand::WindowIsCurrentEvent, impl_->is_current);
    window->SetReadyForRendering(true);
    window->SetMapped(true);
    window->SetSwapBuffers(0);
    window->SetMultiSamples(0);
    window->SetFrameBlitModeToNoBlit();
    if (!window->InitializeFromCurrentContext()) {
        throw std::runtime_error("VTK does not accept the OpenGL of " + impl_->gl_renderer);
    }
}

Offscreen::~Offscreen() {
    impl_->window->Finalize();
}

vtkRenderWindow* Offscreen::window() const {
    return impl_->window;
}

const std::string& Offscreen::gl_renderer() const {
    return impl_->gl_renderer;
}

Image Offscreen::draw(ImageSize size) {
    impl_->context.make_current();
    vtkGenericOpenGLRenderWindow* window = impl_->window;
    window->SetSize(size.width, size.height);
    window->Render();
    vtkNew<vtkUnsignedCharArray> pixels;
    window->GetPixelData(0, 0, size.width - 1, size.height - 1, 0, pixels, 0);
    const auto row_size = 3 * static_cast<std::size_t>(size.width);
    Image image = blank_image(size, 0);
    if (static_cast<std::size_t>(pixels->GetNumberOfValues()) != image.rgb.size()) {
        throw std::runtime_error("VTK gave another number of pixels than asked for");
    }
    for (std::size_t row = 0; row < static_cast<std::size_t>(size.height); ++row) {
        // OpenGL counts rows from the bottom.
        std::memcpy(image.rgb.data() + row * row_size,
                    pixels->GetPointer(0) + image.rgb.size() - (row + 1) * row_size,
                    row_size);
    }
    return image;
}

}  // namespace grainbench::render
