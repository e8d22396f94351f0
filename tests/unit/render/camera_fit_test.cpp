/// Where the camera stands.
#include "render/camera_fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace grainbench::render {
namespace {

std::vector<FitSphere> some_spheres(std::size_t count) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-1.0, 1.0);
    std::vector<FitSphere> spheres;
    for (std::size_t k = 0; k < count; ++k) {
        spheres.push_back({{3.0 + place(random), 0.3 * place(random), 2.0 * place(random)},
                           0.1 + 0.05 * place(random)});
    }
    return spheres;
}

/// Ends of the picture of the spheres, by points all over their surfaces.
Frame seen(const std::vector<FitSphere>& spheres,
           const CameraPose& pose,
           const Camera& camera,
           ImageSize size) {
    Frame all{1e9, -1e9, 1e9, -1e9};
    for (const FitSphere& sphere : spheres) {
        for (int i = 0; i <= 60; ++i) {
            for (int j = 0; j < 120; ++j) {
                const double polar = pi * i / 60.0;
                const double turn = 2.0 * pi * j / 120.0;
                const Vec3 normal{std::sin(polar) * std::cos(turn),
                                  std::sin(polar) * std::sin(turn),
                                  std::cos(polar)};
                const PicturePoint p =
                    project(pose, camera, size, sphere.centre + sphere.radius * normal);
                all = {std::min(all.left, p.x),
                       std::max(all.right, p.x),
                       std::min(all.bottom, p.y),
                       std::max(all.top, p.y)};
            }
        }
    }
    return all;
}

class FitCamera : public testing::TestWithParam<std::tuple<Projection, double, ImageSize>> {};

TEST_P(FitCamera, HoldsEverySphereInTheFrameAndLeavesNoRoom) {
    const auto& [projection, angle, size] = GetParam();
    const Camera camera{.direction = {0.3, 1.0, -0.4},
                        .up = {0, 0, 1},
                        .projection = projection,
                        .view_angle = angle};
    const Frame frame{0.1, 0.7, 0.2, 0.95};
    const std::vector<FitSphere> spheres = some_spheres(30);
    const CameraPose pose = fit_camera(spheres, camera, size, frame);
    const Frame all = seen(spheres, pose, camera, size);
    // The points on the surfaces are some 3 degrees apart, which hides 1 - cos(3 degrees) of a
    // radius; radii are a tenth of the picture or less.
    const double hidden = 2e-4;
    EXPECT_GE(all.left, frame.left - 1e-9);
    EXPECT_LE(all.right, frame.right + 1e-9);
    EXPECT_GE(all.bottom, frame.bottom - 1e-9);
    EXPECT_LE(all.top, frame.top + 1e-9);
    const double slack = std::min((all.left - frame.left) + (frame.right - all.right),
                                  (all.bottom - frame.bottom) + (frame.top - all.top));
    EXPECT_LE(slack, 2.0 * hidden);
}

INSTANTIATE_TEST_SUITE_P(
    Cameras,
    FitCamera,
    testing::Combine(testing::Values(Projection::perspective, Projection::parallel),
                     testing::Values(8.0, 70.0),
                     testing::Values(ImageSize{1600, 1000}, ImageSize{240, 640})));

TEST(FitCamera, ZoomMagnifiesTheMiddle) {
    const std::vector<FitSphere> spheres = some_spheres(5);
    Camera camera;
    const ImageSize size{400, 300};
    const double before = fit_camera(spheres, camera, size, Frame{}).half_height;
    camera.zoom = 2.0;
    // One division and one multiplication.
    EXPECT_NEAR(fit_camera(spheres, camera, size, Frame{}).half_height, before / 2.0, 1e-12);
}

TEST(FitCamera, NothingToSeeGivesAFinitePose) {
    for (const Projection projection : {Projection::perspective, Projection::parallel}) {
        Camera camera;
        camera.projection = projection;
        const CameraPose pose = fit_camera({}, camera, {1, 1}, Frame{});
        EXPECT_TRUE(is_finite(pose.eye));
        EXPECT_GT(pose.half_height, 0.0);
    }
}

}  // namespace
}  // namespace grainbench::render
