#include "render/chart_plot.hpp"

#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkContext2D.h>
#include <vtkObjectFactory.h>
#include <vtkPen.h>

#include <algorithm>
#include <cmath>

namespace grainbench::render {
namespace {

constexpr float line_width = 2.5F;
constexpr float heavy_width = 5.0F;
constexpr float marker_radius = 6.5F;
constexpr unsigned char band_opacity = 60;  // of 255: two bands and a grid stay visible together

}  // namespace

vtkStandardNewMacro(SeriesPlot)

    void SeriesPlot::describe(Part part,
                              const ChartSeries& series,
                              const ChartLook& look,
                              int bar_slot,
                              const Setting& setting) {
    part_ = part;
    series_ = series;
    look_ = look;
    bar_slot_ = bar_slot;
    setting_ = setting;
    SetLabel(series.name);
    SetLegendVisibility(part == Part::strokes && !series.name.empty());
}

bool SeriesPlot::Paint(vtkContext2D* painter) {
    const PixelMatrix in_pixels(painter);
    if (part_ == Part::shade) {
        paint_band(painter);
        return true;
    }
    switch (series_.kind) {
        case SeriesKind::band:
        case SeriesKind::line:
            paint_line(painter);
            break;
        case SeriesKind::points: {
            paint_error_bars(painter);
            for (const std::vector<Pixel>& stroke : strokes()) {
                paint_markers(painter, stroke);
            }
            break;
        }
        case SeriesKind::bars:
            paint_bars(painter);
            paint_error_bars(painter);
            break;
    }
    return true;
}

bool SeriesPlot::PaintLegend(vtkContext2D* painter, const vtkRectf& rect, int /*index*/) {
    const float left = rect.GetX();
    const float right = left + rect.GetWidth();
    const float middle = rect.GetY() + 0.5F * rect.GetHeight();
    const Pixel low{left, rect.GetY()};
    const Pixel high{right, rect.GetY() + rect.GetHeight()};
    if (series_.kind == SeriesKind::bars) {
        paint_bar(painter, low, high);
        return true;
    }
    if (series_.kind == SeriesKind::band) {
        painter->GetPen()->SetLineType(vtkPen::NO_PEN);
        painter->GetBrush()->SetColor(
            look_.colour[0], look_.colour[1], look_.colour[2], band_opacity);
        painter->DrawRect(low[0], low[1], high[0] - low[0], high[1] - low[1]);
    }
    if (series_.kind != SeriesKind::points) {
        use_line(painter, true);
        draw_segment(painter, {left, middle}, {right, middle});
    }
    if (series_.is_heavy) {
        return true;
    }
    paint_markers(painter, {{0.5F * (left + right), middle}});
    return true;
}

std::vector<Pixel> SeriesPlot::covered() const {
    std::vector<Pixel> points;
    constexpr float step = 6.0F;
    const auto add_segment = [&](Pixel a, Pixel b) {
        const float length = std::hypot(b[0] - a[0], b[1] - a[1]);
        const int pieces = std::clamp(static_cast<int>(length / step), 1, 1000);
        for (int k = 0; k <= pieces; ++k) {
            const float t = static_cast<float>(k) / static_cast<float>(pieces);
            points.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
        }
    };
    for (std::size_t k = 0; k < series_.y.size(); ++k) {
        if (series_.kind == SeriesKind::bars) {
            const double foot = std::max(0.0, setting_.ranges.y.low);
            add_segment(pixel_of(across(k), foot), pixel_of(across(k), series_.y[k]));
        }
        if (!series_.low.empty()) {
            add_segment(pixel_of(across(k), series_.low[k]), pixel_of(across(k), series_.high[k]));
        }
    }
    for (std::size_t k = 1; k < series_.low.size() && series_.kind == SeriesKind::band; ++k) {
        const auto between = [&](const std::vector<double>& edge, float t) {
            const Pixel a = pixel_of(series_.x[k - 1], edge[k - 1]);
            const Pixel b = pixel_of(series_.x[k], edge[k]);
            return Pixel{a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
        };
        const float length = between(series_.low, 1.0F)[0] - between(series_.low, 0.0F)[0];
        const int pieces = std::clamp(static_cast<int>(length / step), 1, 1000);
        for (int piece = 0; piece < pieces; ++piece) {
            const float t = static_cast<float>(piece) / static_cast<float>(pieces);
            add_segment(between(series_.low, t), between(series_.high, t));
        }
    }
    for (const std::vector<Pixel>& stroke : strokes()) {
        points.push_back(stroke.front());
        for (std::size_t k = 1; k < stroke.size() && series_.kind != SeriesKind::points; ++k) {
            add_segment(stroke[k - 1], stroke[k]);
        }
        if (series_.kind == SeriesKind::points) {
            points.insert(points.end(), stroke.begin(), stroke.end());
        }
    }
    return points;
}

Pixel SeriesPlot::pixel_of(double x, double y) const {
    return {pixel_along(XAxis, setting_.ranges.x, setting_.ranges.x.place(x), 0),
            pixel_along(YAxis, setting_.ranges.y, setting_.ranges.y.place(y), 1)};
}

double SeriesPlot::bar_place(std::size_t category) const {
    constexpr double group_width = 0.8;  // of the distance between categories
    const double slot = (bar_slot_ + 0.5) / setting_.bar_slots - 0.5;
    return static_cast<double>(category) + group_width * slot;
}

double SeriesPlot::across(std::size_t k) const {
    return series_.kind == SeriesKind::bars ? bar_place(k) : series_.x[k];
}

/// Points in pixels, in runs without gaps.
std::vector<std::vector<Pixel>> SeriesPlot::strokes() const {
    std::vector<std::vector<Pixel>> result;
    bool is_open = false;
    for (std::size_t k = 0; k < series_.y.size(); ++k) {
        const Pixel point = pixel_of(across(k), series_.y[k]);
        if (!std::isfinite(point[0]) || !std::isfinite(point[1])) {
            is_open = false;
            continue;
        }
        if (!is_open) {
            result.emplace_back();
            is_open = true;
        }
        result.back().push_back(point);
    }
    for (std::vector<Pixel>& stroke : result) {
        stroke = thin_out(stroke);
    }
    return result;
}

void SeriesPlot::use_line(vtkContext2D* painter, bool is_dashed) const {
    painter->GetPen()->SetLineType(
        is_dashed && !series_.is_heavy ? look_.dash : static_cast<int>(vtkPen::SOLID_LINE));
    painter->GetPen()->SetWidth((series_.is_heavy ? heavy_width : line_width) * setting_.size);
    painter->GetPen()->SetColor(look_.colour[0], look_.colour[1], look_.colour[2], 255);
}

void SeriesPlot::paint_band(vtkContext2D* painter) const {
    std::vector<float> strip;
    const auto flush = [&] {
        if (strip.size() > 4) {
            painter->DrawQuadStrip(strip.data(), static_cast<int>(strip.size() / 2));
        }
        strip.clear();
    };
    painter->GetPen()->SetLineType(vtkPen::NO_PEN);
    painter->GetBrush()->SetTexture(nullptr);
    painter->GetBrush()->SetColor(look_.colour[0], look_.colour[1], look_.colour[2], band_opacity);
    for (std::size_t k = 0; k < series_.low.size(); ++k) {
        const Pixel low = pixel_of(series_.x[k], series_.low[k]);
        const Pixel high = pixel_of(series_.x[k], series_.high[k]);
        if (std::isfinite(low[0] + low[1] + high[1])) {
            strip.insert(strip.end(), {low[0], low[1], high[0], high[1]});
        } else {
            flush();
        }
    }
    flush();
}

void SeriesPlot::paint_line(vtkContext2D* painter) const {
    constexpr float spacing = 130.0F;  // pixels between two markers
    // Staggered, so that lines that coincide show the markers of each.
    const float offset =
        spacing * (0.3F + 0.6F * std::fmod(static_cast<float>(look_.index) * 0.38F, 1.0F));
    for (const std::vector<Pixel>& stroke : strokes()) {
        use_line(painter, true);
        draw_line(painter, stroke);
        if (!setting_.is_alone && !series_.is_heavy) {
            paint_markers(painter, spread(stroke, spacing * setting_.size, offset * setting_.size));
        }
    }
}

void SeriesPlot::paint_markers(vtkContext2D* painter, const std::vector<Pixel>& points) const {
    // Every other series of points is hollow, so that points that coincide are both seen. On lines
    // a white rim keeps markers apart from the lines below them.
    const bool is_hollow = series_.kind == SeriesKind::points && look_.index % 2 == 1;
    const auto [red, green, blue] = look_.colour;
    painter->GetPen()->SetLineType(vtkPen::SOLID_LINE);
    painter->GetPen()->SetWidth((is_hollow ? line_width : 1.0F) * setting_.size);
    painter->GetBrush()->SetTexture(nullptr);
    if (is_hollow) {
        painter->GetPen()->SetColor(red, green, blue, 255);
        painter->GetBrush()->SetColor(255, 255, 255, 0);
    } else {
        painter->GetPen()->SetColor(255, 255, 255, 255);
        painter->GetBrush()->SetColor(red, green, blue, 255);
    }
    for (const Pixel& point : points) {
        draw_marker(painter, look_.marker, point, marker_radius * setting_.size);
    }
}

void SeriesPlot::paint_error_bars(vtkContext2D* painter) const {
    use_line(painter, false);
    painter->GetPen()->SetWidth(1.5F * setting_.size);
    if (series_.kind == SeriesKind::bars) {
        painter->GetPen()->SetColor(0, 0, 0, 255);
    }
    const float cap = 5.0F * setting_.size;
    for (std::size_t k = 0; k < series_.low.size(); ++k) {
        const Pixel low = pixel_of(across(k), series_.low[k]);
        const Pixel high = pixel_of(across(k), series_.high[k]);
        const bool is_drawable = std::isfinite(low[0] + low[1] + high[1]);
        if (!is_drawable || series_.low[k] == series_.high[k]) {
            continue;
        }
        draw_segment(painter, low, high);
        draw_segment(painter, {low[0] - cap, low[1]}, {low[0] + cap, low[1]});
        draw_segment(painter, {high[0] - cap, high[1]}, {high[0] + cap, high[1]});
    }
}

void SeriesPlot::paint_bars(vtkContext2D* painter) const {
    const double half = 0.36 / setting_.bar_slots;
    for (std::size_t k = 0; k < series_.y.size(); ++k) {
        if (!std::isfinite(series_.y[k])) {
            continue;
        }
        const double foot = setting_.ranges.y.scale == AxisScale::linear
                                ? 0.0
                                : std::pow(10.0, setting_.ranges.y.low);
        const Pixel a = pixel_of(bar_place(k) - half, foot);
        const Pixel b = pixel_of(bar_place(k) + half, series_.y[k]);
        paint_bar(painter, {a[0], std::min(a[1], b[1])}, {b[0], std::max(a[1], b[1])});
    }
}

void SeriesPlot::paint_bar(vtkContext2D* painter, Pixel low, Pixel high) const {
    painter->GetPen()->SetLineType(vtkPen::SOLID_LINE);
    painter->GetPen()->SetWidth(setting_.size);
    painter->GetPen()->SetColor(40, 40, 40, 255);
    painter->GetBrush()->SetTexture(nullptr);
    painter->GetBrush()->SetColor(look_.colour[0], look_.colour[1], look_.colour[2], 255);
    painter->DrawRect(low[0], low[1], high[0] - low[0], high[1] - low[1]);
    painter->GetPen()->SetColor(255, 255, 255, 255);
    painter->GetPen()->SetWidth(2.0F * setting_.size);
    draw_hatch(painter, look_.hatch, low, high, 12.0F * setting_.size);
}

}  // namespace grainbench::render
