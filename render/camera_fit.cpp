#include "render/camera_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace grainbench::render {
namespace {

constexpr double lowest = -std::numeric_limits<double>::infinity();

/// Sphere in the axes of the picture.
struct ViewSphere {
    double right, up, back, radius;
};

struct Interval {
    double low = 0.0;
    double high = 0.0;

    double middle() const { return 0.5 * (low + high); }
};

template <class Coordinate>
Interval extent(const std::vector<ViewSphere>& spheres, Coordinate coordinate) {
    Interval all{-lowest, lowest};
    for (const ViewSphere& sphere : spheres) {
        all.low = std::min(all.low, coordinate(sphere) - sphere.radius);
        all.high = std::max(all.high, coordinate(sphere) + sphere.radius);
    }
    return all;
}

/// The nearest eye of a perspective along one axis of the picture: its coordinate on this axis and
/// its distance. A sphere is inside the two planes through the eye, |s - eye| <= tangent (distance
/// - back), with room for its radius across the planes.
struct Stand {
    double place, distance;
};

template <class Coordinate>
Stand stand(const std::vector<ViewSphere>& spheres, Coordinate coordinate, double tangent) {
    const double slant = std::sqrt(1.0 + tangent * tangent);
    double high = lowest;
    double low = lowest;
    for (const ViewSphere& sphere : spheres) {
        const double reach = tangent * sphere.back + slant * sphere.radius;
        high = std::max(high, coordinate(sphere) + reach);
        low = std::max(low, -coordinate(sphere) + reach);
    }
    return {0.5 * (high - low), 0.5 * (high + low) / tangent};
}

constexpr auto right_of = [](const ViewSphere& sphere) { return sphere.right; };
constexpr auto up_of = [](const ViewSphere& sphere) { return sphere.up; };
constexpr auto back_of = [](const ViewSphere& sphere) { return sphere.back; };

std::vector<ViewSphere> in_view(const std::vector<FitSphere>& spheres, const ViewAxes& axes) {
    std::vector<ViewSphere> seen;
    for (const FitSphere& sphere : spheres) {
        if (is_finite(sphere.centre)) {
            seen.push_back({dot(sphere.centre, axes.right),
                            dot(sphere.centre, axes.up),
                            dot(sphere.centre, axes.back),
                            sphere.radius});
        }
    }
    if (seen.empty()) {
        seen.push_back({0.0, 0.0, 0.0, 1.0});
    }
    return seen;
}

double tangent_of(const Camera& camera) {
    return std::tan(0.5 * camera.view_angle * pi / 180.0);
}

double aspect_of(ImageSize size) {
    return static_cast<double>(size.width) / static_cast<double>(size.height);
}

}  // namespace

ViewAxes view_axes(const Camera& camera) {
    ViewAxes axes;
    axes.back = -normalized(camera.direction);
    axes.right = normalized(cross(camera.up, axes.back));
    axes.up = cross(axes.back, axes.right);
    return axes;
}

CameraPose fit_camera(const std::vector<FitSphere>& spheres,
                      const Camera& camera,
                      ImageSize size,
                      const Frame& frame) {
    CameraPose pose;
    pose.axes = view_axes(camera);
    const std::vector<ViewSphere> seen = in_view(spheres, pose.axes);
    const Interval depth = extent(seen, back_of);
    // Half of the frame, in half heights of the picture.
    const double half_width = aspect_of(size) * (frame.right - frame.left);
    const double half_height = frame.top - frame.bottom;
    double place_right = 0.0;
    double place_up = 0.0;
    double distance = 0.0;
    if (camera.projection == Projection::parallel) {
        const Interval across = extent(seen, right_of);
        const Interval upward = extent(seen, up_of);
        place_right = across.middle();
        place_up = upward.middle();
        pose.half_height = std::max(0.5 * (across.high - across.low) / half_width,
                                    0.5 * (upward.high - upward.low) / half_height);
        pose.half_height /= camera.zoom;
        distance = 2.0 * (depth.high - depth.low) + pose.half_height;
    } else {
        const double tangent = tangent_of(camera);
        const Stand across = stand(seen, right_of, tangent * half_width);
        const Stand upward = stand(seen, up_of, tangent * half_height);
        place_right = across.place;
        place_up = upward.place;
        // Zoom acts on the size at the middle depth.
        distance = (std::max(across.distance, upward.distance) - depth.middle()) / camera.zoom;
        pose.half_height = tangent * distance;
    }
    pose.focus =
        place_right * pose.axes.right + place_up * pose.axes.up + depth.middle() * pose.axes.back;
    pose.eye = pose.focus + distance * pose.axes.back;
    // The axis of the camera meets the middle of the frame.
    pose.centre_x = 1.0 - (frame.left + frame.right);
    pose.centre_y = 1.0 - (frame.bottom + frame.top);
    return pose;
}

PicturePoint project(const CameraPose& pose,
                     const Camera& camera,
                     ImageSize size,
                     const Vec3& point) {
    const Vec3 from_eye = point - pose.eye;
    const double ahead = -dot(from_eye, pose.axes.back);
    const double half_height =
        camera.projection == Projection::parallel ? pose.half_height : tangent_of(camera) * ahead;
    const double x = dot(from_eye, pose.axes.right) / (half_height * aspect_of(size));
    const double y = dot(from_eye, pose.axes.up) / half_height;
    return {0.5 * (1.0 + x - pose.centre_x), 0.5 * (1.0 + y - pose.centre_y)};
}

}  // namespace grainbench::render
