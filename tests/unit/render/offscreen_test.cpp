/// The window without display.
#include "render/offscreen.hpp"

#include "io/vtk/session.hpp"

#include "render/self_test.hpp"

#include <gmock/gmock.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

namespace grainbench::render {
namespace {

using testing::Each;
using testing::HasSubstr;

TEST(Offscreen, DrawsWithoutDisplayAndNamesItsRenderer) {
    unsetenv("DISPLAY");
    EXPECT_THAT(test_drawing(), HasSubstr("OpenGL"));
}

TEST(Offscreen, GivesTheSizeAskedForAgainAndAgain) {
    const io::VtkSession session;
    Offscreen offscreen;
    vtkNew<vtkRenderer> renderer;
    renderer->SetBackground(0.0, 0.0, 0.0);
    offscreen.window()->AddRenderer(renderer);
    for (const ImageSize size : {ImageSize{1, 1}, {64, 48}, {7, 300}, {64, 48}}) {
        const Image image = offscreen.draw(size);
        EXPECT_EQ(image.size, size);
        EXPECT_EQ(image.rgb.size(), static_cast<std::size_t>(3 * size.width * size.height));
        EXPECT_THAT(image.rgb, Each(0));
    }
    EXPECT_EQ(session.error(), "");
}

}  // namespace
}  // namespace grainbench::render
