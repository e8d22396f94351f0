#include "render/chart_plot.hpp"

#include "render/colour_map.hpp"

#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkContext2D.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPen.h>
#include <vtkTextProperty.h>
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

constexpr float line_width = 2.5F;
constexpr float marker_radius = 6.5F;
constexpr unsigned char band_opacity = 60;  // of 255: two bands and a grid stay visible together

std::array<unsigned char, 3> bytes_of(const Colour& colour) {
    const auto byte = [](double part) {
        return static_cast<unsigned char>(std::lround(255.0 * part));
    };
    return {byte(colour.red), byte(colour.green), byte(colour.blue)};
}

/// Draws in pixels for as long as it lives, whatever matrix the chart has set.
class PixelMatrix {
public:
    explicit PixelMatrix(vtkContext2D* painter) : painter_(painter) {
        painter_->PushMatrix();
        const vtkNew<vtkTransform2D> identity;
        painter_->SetTransform(identity);
    }

    ~PixelMatrix() { painter_->PopMatrix(); }

    PixelMatrix(const PixelMatrix&) = delete;
    PixelMatrix& operator=(const PixelMatrix&) = delete;

private:
    vtkContext2D* painter_;
};

/// Where a number lies between the ends of an axis.
float pixel_along(vtkAxis* axis, const AxisRange& range, double place, int component) {
    const double fraction = (place - range.low) / (range.high - range.low);
    const double first = axis->GetPosition1()[component];
    const double last = axis->GetPosition2()[component];
    return static_cast<float>(first + fraction * (last - first));
}

/// Keeps of each pixel column the first, lowest, highest and last point, in their order: the same
/// picture from a fraction of the points.
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

/// Points spread evenly along a line, about one for each `spacing` pixels.
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

void draw_line(vtkContext2D* painter, std::vector<Pixel> line) {
    if (line.size() > 1) {
        painter->DrawPoly(line.front().data(), static_cast<int>(line.size()));
    }
}

/// A segment as vtkContext2D wants it.
void draw_segment(vtkContext2D* painter, Pixel a, Pixel b) {
    painter->DrawLine(a[0], a[1], b[0], b[1]);
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

/// Lines across a rectangle at 45 degrees, rising or falling.
void draw_hatch(vtkContext2D* painter, Pixel low, Pixel high, float gap, bool is_rising) {
    const float width = high[0] - low[0];
    const float height = high[1] - low[1];
    for (float start = -height; start < width; start += gap) {
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
    painter->GetPen()->SetLineType(is_dashed ? look_.dash : static_cast<int>(vtkPen::SOLID_LINE));
    painter->GetPen()->SetWidth(line_width * setting_.size);
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
        if (!setting_.is_alone) {
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
    const std::vector<Pixel> outline = outline_of(look_.marker);
    for (const Pixel& point : points) {
        std::vector<float> corners;
        for (const Pixel& corner : outline) {
            for (std::size_t k = 0; k < 2; ++k) {
                corners.push_back(point[k] + marker_radius * setting_.size * corner[k]);
            }
        }
        painter->DrawPolygon(corners.data(), static_cast<int>(outline.size()));
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
    const float gap = 12.0F * setting_.size;
    if (look_.hatch == ChartLook::Hatch::rising || look_.hatch == ChartLook::Hatch::crossed) {
        draw_hatch(painter, low, high, gap, true);
    }
    if (look_.hatch == ChartLook::Hatch::falling || look_.hatch == ChartLook::Hatch::crossed) {
        draw_hatch(painter, low, high, gap, false);
    }
}

vtkStandardNewMacro(NotesPlot)

    void NotesPlot::describe(const Chart& chart,
                             const ChartRanges& ranges,
                             int font_size,
                             float size) {
    chart_.vertical_lines = chart.vertical_lines;
    chart_.texts = chart.texts;
    ranges_ = ranges;
    font_size_ = font_size;
    size_ = size;
    SetLegendVisibility(false);
}

bool NotesPlot::Paint(vtkContext2D* painter) {
    const PixelMatrix in_pixels(painter);
    const vtkNew<vtkTextProperty> text;
    text->SetFontSize(font_size_);
    text->SetColor(0.2, 0.2, 0.2);
    text->SetFontFamilyToArial();
    const float gap = 5.0F * size_;
    for (const VerticalLine& line : chart_.vertical_lines) {
        const double place = ranges_.x.place(line.x);
        if (!(place >= ranges_.x.low && place <= ranges_.x.high)) {
            continue;
        }
        const float x = pixel_along(XAxis, ranges_.x, place, 0);
        const float bottom = YAxis->GetPosition1()[1];
        const float top = YAxis->GetPosition2()[1];
        painter->GetPen()->SetLineType(vtkPen::DASH_LINE);
        painter->GetPen()->SetWidth(1.5F * size_);
        painter->GetPen()->SetColor(90, 90, 90, 255);
        draw_segment(painter, {x, bottom}, {x, top});
        text->SetOrientation(90.0);
        text->SetJustificationToRight();
        paint_text(painter, text, {x - gap, top - gap}, line.text);
    }
    text->SetOrientation(0.0);
    text->SetJustificationToLeft();
    for (const ChartText& note : chart_.texts) {
        paint_text(painter,
                   text,
                   {pixel_along(XAxis, ranges_.x, ranges_.x.place(note.x), 0),
                    pixel_along(YAxis, ranges_.y, ranges_.y.place(note.y), 1)},
                   note.text);
    }
    return true;
}

std::vector<Pixel> NotesPlot::covered() const {
    std::vector<Pixel> points;
    const float bottom = YAxis->GetPosition1()[1];
    const float top = YAxis->GetPosition2()[1];
    const auto text_height = static_cast<float>(font_size_);
    for (const VerticalLine& line : chart_.vertical_lines) {
        const float x = pixel_along(XAxis, ranges_.x, ranges_.x.place(line.x), 0);
        for (float y = bottom; y <= top; y += text_height) {
            points.push_back({x, y});
            points.push_back({x - text_height, y});
        }
    }
    return points;
}

/// On a light ground, so that it can be read where lines run through it.
void NotesPlot::paint_text(vtkContext2D* painter,
                           vtkTextProperty* property,
                           Pixel corner,
                           const std::string& text) const {
    if (text.empty()) {
        return;
    }
    const double turned = property->GetOrientation();
    property->SetVerticalJustificationToBottom();
    property->SetOrientation(0.0);
    painter->ApplyTextProp(property);
    std::array<float, 4> box{};  // x, y, width, height
    painter->ComputeStringBounds(text.c_str(), box.data());
    painter->GetPen()->SetLineType(vtkPen::NO_PEN);
    painter->GetBrush()->SetTexture(nullptr);
    painter->GetBrush()->SetColor(255, 255, 255, 210);
    if (turned == 0.0) {
        painter->DrawRect(corner[0], corner[1], box[2], box[3]);
    } else {
        // Turned by a quarter, the text ends at the corner and stands to the left of it.
        painter->DrawRect(corner[0] - box[3], corner[1] - box[2], box[3], box[2]);
    }
    property->SetOrientation(turned);
    painter->ApplyTextProp(property);
    painter->DrawString(corner[0], corner[1], text.c_str());
}

vtkStandardNewMacro(TitlesItem)

    bool TitlesItem::Paint(vtkContext2D* painter) {
    const vtkNew<vtkTextProperty> text;
    text->SetColor(0.0, 0.0, 0.0);
    text->SetFontFamilyToArial();
    text->SetJustificationToCentered();
    text->SetVerticalJustificationToBottom();
    for (const Title& title : titles_) {
        text->SetFontSize(title.font_size);
        text->SetBold(title.is_bold ? 1 : 0);
        text->SetOrientation(title.turned);
        painter->ApplyTextProp(text);
        painter->DrawString(title.centre[0], title.centre[1], title.text.c_str());
    }
    return true;
}

}  // namespace grainbench::render
