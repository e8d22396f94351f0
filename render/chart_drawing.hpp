/// How series look, and shapes in pixels for all that a chart draws. Internal to render: shows VTK.
#pragma once

#include "render/chart_scale.hpp"

#include <array>
#include <cstddef>
#include <vector>

class vtkAxis;
class vtkContext2D;

namespace grainbench::render {

/// How a series looks: told apart by colour, and without colour by dash, marker or hatch.
struct ChartLook {
    std::size_t index = 0;
    std::array<unsigned char, 3> colour{};
    int dash = 0;  ///< vtkPen line type
    enum class Marker { circle, square, diamond, triangle, inverted_triangle } marker{};
    enum class Hatch { none, rising, falling, crossed } hatch{};
};

/// Looks repeat after a while, in combinations of colour and dash that do not.
ChartLook chart_look(std::size_t index);

/// A point in pixels.
using Pixel = std::array<float, 2>;

/// Draws in pixels for as long as it lives, whatever matrix the chart has set.
class PixelMatrix {
public:
    explicit PixelMatrix(vtkContext2D* painter);
    ~PixelMatrix();
    PixelMatrix(const PixelMatrix&) = delete;
    PixelMatrix& operator=(const PixelMatrix&) = delete;

private:
    vtkContext2D* painter_;
};

/// Where a number lies between the ends of an axis: component 0 of an axis across, 1 of one
/// upwards.
float pixel_along(vtkAxis* axis, const AxisRange& range, double place, int component);

void draw_line(vtkContext2D* painter, std::vector<Pixel> line);
void draw_segment(vtkContext2D* painter, Pixel a, Pixel b);

/// With the pen and brush that are set.
/// \param radius [px] of a circle that looks as large
void draw_marker(vtkContext2D* painter, ChartLook::Marker marker, Pixel centre, float radius);

/// Lines across a rectangle at 45 degrees.
void draw_hatch(vtkContext2D* painter, ChartLook::Hatch hatch, Pixel low, Pixel high, float gap);

/// Keeps of each pixel column the first, lowest, highest and last point, in their order: the same
/// picture from a fraction of the points.
std::vector<Pixel> thin_out(const std::vector<Pixel>& points);

/// Points spread evenly along a line, one for each `spacing` pixels across.
std::vector<Pixel> spread(const std::vector<Pixel>& line, float spacing, float offset);

}  // namespace grainbench::render
