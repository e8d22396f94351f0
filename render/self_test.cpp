#include "render/self_test.hpp"

#include "io/vtk/session.hpp"

#include "render/offscreen.hpp"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>

#include <stdexcept>

namespace grainbench::render {

std::string test_drawing() {
    const io::VtkSession session;
    Offscreen offscreen;
    vtkNew<vtkSphereSource> sphere;
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(sphere->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetColor(1.0, 0.0, 0.0);
    vtkNew<vtkRenderer> renderer;
    renderer->AddActor(actor);
    renderer->SetBackground(1.0, 1.0, 1.0);
    offscreen.window()->AddRenderer(renderer);
    const Image image = offscreen.draw({33, 33});
    const std::size_t centre = 3 * (33 * 16 + 16);
    const bool is_corner_white = image.rgb[0] > 250 && image.rgb[1] > 250 && image.rgb[2] > 250;
    const bool is_centre_red = image.rgb[centre] > 200 && image.rgb[centre + 1] < 20;
    if (!session.error().empty() || !is_corner_white || !is_centre_red) {
        throw std::runtime_error("a test picture drawn by " + offscreen.gl_renderer() +
                                 " is wrong. " + session.error());
    }
    return offscreen.gl_renderer();
}

}  // namespace grainbench::render
