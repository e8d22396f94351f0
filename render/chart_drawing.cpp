#include "render/chart_drawing.hpp"

#include "render/colour_map.hpp"

#include <vtkAxis.h>
#include <vtkContext2D.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkTransform2D.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grainbench::render {
namespace {

constexpr std::array dashes{
    vtkPen::SOLID_LINE, vtkPen::DASH_LINE, vtkPen::DASH_DOT_LINE, vtkPen::DASH_DOT_DOT_LINE};
constexpr std::size_t markers = 5;
constexpr std::size_t hatches = 4;

std::array<unsigned char, 3> bytes_of(const Colour& colour) {
    const auto byte = [](double part) {
        return static_cast<unsigned char>(std::lround(255.0 * part));
    };
    return {byte(colour.red), byte(colour.green), byte(colour.blue)};
}

/// Corners of a marker of radius 1.
std::vector<Pixel> outline_of(ChartLook::Marker marker) {
    struct Polygon {
        int corners;
        double first;   ///< [turn] direction of the first corner
        double radius;  ///< makes all markers look equally large
    };

    const auto polygon = [&]() -> Polygon {
        switch (marker) {
            case ChartLook::Marker::square:
                return {4, 0.125, 1.2};
            case ChartLook::Marker::diamond:
                return {4, 0.0, 1.3};
            case ChartLook::Marker::triangle:
                return {3, 0.25, 1.35};
            case ChartLook::Marker::inverted_triangle:
                return {3, 0.75, 1.35};
            case ChartLook::Marker::circle:
                break;
        }
        return {24, 0.0, 1.0};
    }();
    std::vector<Pixel> corners;
    for (int k = 0; k < polygon.corners; ++k) {
        const double angle =
            2.0 * std::numbers::pi * (polygon.first + static_cast<double>(k) / polygon.corners);
        corners.push_back({static_cast<float>(polygon.radius * std::cos(angle)),
                           static_cast<float>(polygon.radius * std::sin(angle))});
    }
    return corners;
}

/// Rising or falling lines.
void draw_stripes(vtkContext2D* painter, Pixel low, Pixel high, float gap, bool is_rising) {
    const float width = high[0] - low[0];
    const float height = high[1] - low[1];
    const auto stripes = static_cast<int>((width + height) / gap);
    for (int k = 0; k <= stripes; ++k) {
        const float start = -height + static_cast<float>(k) * gap;
        const float from = std::max(0.0F, -start);
        const float to = std::min(height, width - start);
        if (to <= from) {
            continue;
        }
        const auto at = [&](float rise) {
            const float x = start + rise;
            return Pixel{low[0] + (is_rising ? x : width - x), low[1] + rise};
        };
        draw_segment(painter, at(from), at(to));
    }
}

}  // namespace

ChartLook chart_look(std::size_t index) {
    // Black is the seventh colour, which no line of the palette has.
    constexpr std::size_t colours = 7;
    const std::size_t k = index % colours;
    return {.index = index,
            .colour = bytes_of(k + 1 == colours ? Colour{} : line_colour(k, false)),
            .dash = dashes[index % dashes.size()],
            .marker = static_cast<ChartLook::Marker>(index % markers),
            .hatch = static_cast<ChartLook::Hatch>(index % hatches)};
}

PixelMatrix::PixelMatrix(vtkContext2D* painter) : painter_(painter) {
    painter_->PushMatrix();
    const vtkNew<vtkTransform2D> identity;
    painter_->SetTransform(identity);
}

PixelMatrix::~PixelMatrix() {
    painter_->PopMatrix();
}

float pixel_along(vtkAxis* axis, const AxisRange& range, double place, int component) {
    const double fraction = (place - range.low) / (range.high - range.low);
    const double first = axis->GetPosition1()[component];
    const double last = axis->GetPosition2()[component];
    return static_cast<float>(first + fraction * (last - first));
}

void draw_line(vtkContext2D* painter, std::vector<Pixel> line) {
    if (line.size() > 1) {
        painter->DrawPoly(line.front().data(), static_cast<int>(line.size()));
    }
}

void draw_segment(vtkContext2D* painter, Pixel a, Pixel b) {
    painter->DrawLine(a[0], a[1], b[0], b[1]);
}

void draw_marker(vtkContext2D* painter, ChartLook::Marker marker, Pixel centre, float radius) {
    const std::vector<Pixel> outline = outline_of(marker);
    std::vector<float> corners;
    for (const Pixel& corner : outline) {
        corners.push_back(centre[0] + radius * corner[0]);
        corners.push_back(centre[1] + radius * corner[1]);
    }
    painter->DrawPolygon(corners.data(), static_cast<int>(outline.size()));
}

void draw_hatch(vtkContext2D* painter, ChartLook::Hatch hatch, Pixel low, Pixel high, float gap) {
    if (hatch == ChartLook::Hatch::rising || hatch == ChartLook::Hatch::crossed) {
        draw_stripes(painter, low, high, gap, true);
    }
    if (hatch == ChartLook::Hatch::falling || hatch == ChartLook::Hatch::crossed) {
        draw_stripes(painter, low, high, gap, false);
    }
}

std::vector<Pixel> thin_out(const std::vector<Pixel>& points) {
    constexpr std::size_t enough = 4000;
    if (points.size() <= enough) {
        return points;
    }
    std::vector<Pixel> kept;
    std::size_t begin = 0;
    while (begin < points.size()) {
        std::size_t end = begin;
        std::size_t lowest = begin;
        std::size_t highest = begin;
        while (end < points.size() && std::floor(points[end][0]) == std::floor(points[begin][0])) {
            lowest = points[end][1] < points[lowest][1] ? end : lowest;
            highest = points[end][1] > points[highest][1] ? end : highest;
            ++end;
        }
        std::array<std::size_t, 4> chosen{begin, lowest, highest, end - 1};
        std::sort(chosen.begin(), chosen.end());
        for (auto k = chosen.begin(); k != std::unique(chosen.begin(), chosen.end()); ++k) {
            kept.push_back(points[*k]);
        }
        begin = end;
    }
    return kept;
}

std::vector<Pixel> spread(const std::vector<Pixel>& line, float spacing, float offset) {
    std::vector<Pixel> points;
    float next = offset;
    float run = 0.0F;
    for (std::size_t k = 1; k < line.size(); ++k) {
        // Along x only: a trembling line is no longer than a smooth one.
        const float step = std::abs(line[k][0] - line[k - 1][0]);
        while (run + step >= next && step > 0.0F) {
            const float t = (next - run) / step;
            points.push_back({line[k - 1][0] + t * (line[k][0] - line[k - 1][0]),
                              line[k - 1][1] + t * (line[k][1] - line[k - 1][1])});
            next += spacing;
        }
        run += step;
    }
    return points;
}

}  // namespace grainbench::render
