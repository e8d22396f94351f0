/// Where the camera stands so that given spheres just fit into a part of the picture. Closed
/// formulas, no search; knows no VTK. Internal to render.
#pragma once

#include "core/types.hpp"

#include "render/image.hpp"
#include "render/look.hpp"

#include <vector>

namespace grainbench::render {

struct FitSphere {
    Vec3 centre{};        ///< [m]
    double radius = 0.0;  ///< [m]
};

/// Part of a picture, as fractions of its width and height from the lower left.
struct Frame {
    double left = 0.0;
    double right = 1.0;
    double bottom = 0.0;
    double top = 1.0;
};

/// Axes of the picture in space: right, up, and back towards the eye.
struct ViewAxes {
    Vec3 right{};
    Vec3 up{};
    Vec3 back{};
};

ViewAxes view_axes(const Camera& camera);

struct CameraPose {
    ViewAxes axes;
    Vec3 eye{};                ///< [m]
    Vec3 focus{};              ///< [m] on the axis of the camera, at the depth of the middle
    double half_height = 1.0;  ///< [m] half of what the picture shows at the depth of `focus`
    /// [1] shift of the picture, in half widths and half heights: vtkCamera's window centre
    double centre_x = 0.0;
    double centre_y = 0.0;
};

/// \param spheres may be empty; the camera then looks at the origin from afar
CameraPose fit_camera(const std::vector<FitSphere>& spheres,
                      const Camera& camera,
                      ImageSize size,
                      const Frame& frame);

/// Where a point appears, as fractions of width and height from the lower left.
struct PicturePoint {
    double x = 0.0;
    double y = 0.0;
};

PicturePoint project(const CameraPose& pose,
                     const Camera& camera,
                     ImageSize size,
                     const Vec3& point);

}  // namespace grainbench::render
