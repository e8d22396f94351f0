/// Spheres, walls and traces as a VTK scene. Internal to render: shows VTK.
#pragma once

#include "core/frame.hpp"

#include "io/history.hpp"

#include "render/camera_fit.hpp"
#include "render/look.hpp"
#include "render/particle_view.hpp"

#include <vector>

class vtkRenderer;

namespace grainbench::render {

/// Background, lights and the passes that smooth and shade.
/// \param mean_radius [m] of the spheres, for the reach of ambient occlusion
void set_up(vtkRenderer* renderer, const Look& look, double mean_radius);

/// \param shift where this realisation stands in the picture
void add_spheres(vtkRenderer* renderer, const Spheres& spheres, const Vec3& shift);

/// Adds them after the spheres: what is translucent comes last, far sides before near ones.
void add_walls(vtkRenderer* renderer,
               const std::vector<WallSurface>& walls,
               const WallLook& look,
               bool is_background_dark,
               double line_width,
               const Vec3& shift);

void add_traces(vtkRenderer* renderer,
                const io::TraceTable& traces,
                const std::vector<Colour>& colours,
                double radius,
                const Vec3& shift);

void set_camera(vtkRenderer* renderer, const CameraPose& pose, const Camera& camera);

}  // namespace grainbench::render
