#include "render/gl_entry_points.hpp"

#include "core/error.hpp"

#include <GL/gl.h>
#include <dlfcn.h>

#include <stdexcept>
#include <string>

namespace grainbench::render {
namespace {

constexpr const char* library_name = "libOSMesa.so.8";

[[noreturn]] void throw_no_osmesa(const char* reason) {
    throw_input_output({.what = "cannot draw without OSMesa: " +
                                std::string(reason == nullptr ? "no reason given" : reason),
                        .where = library_name,
                        .likely_cause = "the package libosmesa6 is not installed",
                        .next_step = "apt-get install libosmesa6, then try `grainbench doctor`"});
}

template <class Function>
Function symbol(void* library, const char* name) {
    void* address = dlsym(library, name);
    if (address == nullptr) {
        throw_no_osmesa(dlerror());
    }
    return reinterpret_cast<Function>(address);
}

/// The library stays loaded until the program ends: VTK keeps addresses of its functions.
OsMesa open_library() {
    void* library = dlopen(library_name, RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) {
        throw_no_osmesa(dlerror());
    }
    return {symbol<decltype(OsMesa::create_context)>(library, "OSMesaCreateContextAttribs"),
            symbol<decltype(OsMesa::make_current)>(library, "OSMesaMakeCurrent"),
            symbol<decltype(OsMesa::destroy_context)>(library, "OSMesaDestroyContext"),
            symbol<decltype(OsMesa::entry_point)>(library, "OSMesaGetProcAddress")};
}

/// Address of an OpenGL function in OSMesa; `function` only tells its type.
template <class Function>
Function* osmesa_twin(Function* /*function*/, const char* name) {
    const OSMESAproc address = load_osmesa().entry_point(name);
    if (address == nullptr) {
        throw std::runtime_error("OSMesa has no function " + std::string(name));
    }
    return reinterpret_cast<Function*>(address);
}

}  // namespace

const OsMesa& load_osmesa() {
    static const OsMesa osmesa = open_library();
    return osmesa;
}

}  // namespace grainbench::render

/// Defines one OpenGL function; its type is checked against the declaration in GL/gl.h.
#define GRAINBENCH_TO_OSMESA(result, name, parameters, arguments)                \
    result name parameters {                                                     \
        static auto* const twin = grainbench::render::osmesa_twin(&name, #name); \
        return twin arguments;                                                   \
    }

// What VTK's rendering libraries import from libGL: `nm -D libvtkRendering*.so` lists it, and the
// test render.every_imported_gl_function_leads_to_osmesa compares. All else they ask GLEW for.
extern "C" {

// clang-format off
GRAINBENCH_TO_OSMESA(void, glBindTexture, (GLenum target, GLuint texture), (target, texture))
GRAINBENCH_TO_OSMESA(void, glClear, (GLbitfield mask), (mask))
GRAINBENCH_TO_OSMESA(void, glClearColor, (GLclampf r, GLclampf g, GLclampf b, GLclampf a), (r, g, b, a))
GRAINBENCH_TO_OSMESA(void, glClearDepth, (GLclampd depth), (depth))
GRAINBENCH_TO_OSMESA(void, glClearStencil, (GLint s), (s))
GRAINBENCH_TO_OSMESA(void, glColorMask, (GLboolean r, GLboolean g, GLboolean b, GLboolean a), (r, g, b, a))
GRAINBENCH_TO_OSMESA(void, glCopyTexImage2D, (GLenum target, GLint level, GLenum format, GLint x, GLint y, GLsizei width, GLsizei height, GLint border), (target, level, format, x, y, width, height, border))
GRAINBENCH_TO_OSMESA(void, glCullFace, (GLenum mode), (mode))
GRAINBENCH_TO_OSMESA(void, glDeleteTextures, (GLsizei n, const GLuint* textures), (n, textures))
GRAINBENCH_TO_OSMESA(void, glDepthFunc, (GLenum func), (func))
GRAINBENCH_TO_OSMESA(void, glDepthMask, (GLboolean flag), (flag))
GRAINBENCH_TO_OSMESA(void, glDisable, (GLenum cap), (cap))
GRAINBENCH_TO_OSMESA(void, glDrawArrays, (GLenum mode, GLint first, GLsizei count), (mode, first, count))
GRAINBENCH_TO_OSMESA(void, glDrawElements, (GLenum mode, GLsizei count, GLenum type, const GLvoid* indices), (mode, count, type, indices))
GRAINBENCH_TO_OSMESA(void, glEnable, (GLenum cap), (cap))
GRAINBENCH_TO_OSMESA(void, glFinish, (), ())
GRAINBENCH_TO_OSMESA(void, glFlush, (), ())
GRAINBENCH_TO_OSMESA(void, glGenTextures, (GLsizei n, GLuint* textures), (n, textures))
GRAINBENCH_TO_OSMESA(void, glGetBooleanv, (GLenum name, GLboolean* values), (name, values))
GRAINBENCH_TO_OSMESA(void, glGetDoublev, (GLenum name, GLdouble* values), (name, values))
GRAINBENCH_TO_OSMESA(GLenum, glGetError, (), ())
GRAINBENCH_TO_OSMESA(void, glGetFloatv, (GLenum name, GLfloat* values), (name, values))
GRAINBENCH_TO_OSMESA(void, glGetIntegerv, (GLenum name, GLint* values), (name, values))
GRAINBENCH_TO_OSMESA(const GLubyte*, glGetString, (GLenum name), (name))
GRAINBENCH_TO_OSMESA(void, glGetTexImage, (GLenum target, GLint level, GLenum format, GLenum type, GLvoid* pixels), (target, level, format, type, pixels))
GRAINBENCH_TO_OSMESA(void, glGetTexLevelParameteriv, (GLenum target, GLint level, GLenum name, GLint* values), (target, level, name, values))
GRAINBENCH_TO_OSMESA(GLboolean, glIsEnabled, (GLenum cap), (cap))
GRAINBENCH_TO_OSMESA(void, glLineWidth, (GLfloat width), (width))
GRAINBENCH_TO_OSMESA(void, glPixelStorei, (GLenum name, GLint value), (name, value))
GRAINBENCH_TO_OSMESA(void, glPointSize, (GLfloat size), (size))
GRAINBENCH_TO_OSMESA(void, glReadBuffer, (GLenum mode), (mode))
GRAINBENCH_TO_OSMESA(void, glReadPixels, (GLint x, GLint y, GLsizei width, GLsizei height, GLenum format, GLenum type, GLvoid* pixels), (x, y, width, height, format, type, pixels))
GRAINBENCH_TO_OSMESA(void, glScissor, (GLint x, GLint y, GLsizei width, GLsizei height), (x, y, width, height))
GRAINBENCH_TO_OSMESA(void, glTexEnvi, (GLenum target, GLenum name, GLint value), (target, name, value))
GRAINBENCH_TO_OSMESA(void, glTexImage1D, (GLenum target, GLint level, GLint internal, GLsizei width, GLint border, GLenum format, GLenum type, const GLvoid* pixels), (target, level, internal, width, border, format, type, pixels))
GRAINBENCH_TO_OSMESA(void, glTexImage2D, (GLenum target, GLint level, GLint internal, GLsizei width, GLsizei height, GLint border, GLenum format, GLenum type, const GLvoid* pixels), (target, level, internal, width, height, border, format, type, pixels))
GRAINBENCH_TO_OSMESA(void, glTexParameterf, (GLenum target, GLenum name, GLfloat value), (target, name, value))
GRAINBENCH_TO_OSMESA(void, glTexParameterfv, (GLenum target, GLenum name, const GLfloat* values), (target, name, values))
GRAINBENCH_TO_OSMESA(void, glTexParameteri, (GLenum target, GLenum name, GLint value), (target, name, value))
GRAINBENCH_TO_OSMESA(void, glViewport, (GLint x, GLint y, GLsizei width, GLsizei height), (x, y, width, height))

// clang-format on

// What GLEW calls. Declared here, since the headers that declare them need X11.

GLAPI OSMESAproc glXGetProcAddress(const GLubyte* name) {
    return grainbench::render::load_osmesa().entry_point(reinterpret_cast<const char*>(name));
}

GLAPI OSMESAproc glXGetProcAddressARB(const GLubyte* name) {
    return glXGetProcAddress(name);
}

/// GLEW looks for a display here; there is none, and 0 is its GLEW_OK.
GLAPI GLenum glxewInit() {
    return 0;
}

#ifdef __SANITIZE_ADDRESS__
/// OSMesa keeps some two hundred bytes of each context, which a leak checker reports.
GLAPI const char* __lsan_default_suppressions() {
    return "leak:libOSMesa";
}
#endif

}  // extern "C"
