#include "render/chart_notes.hpp"

#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkContext2D.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPen.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>

namespace grainbench::render {
namespace {

/// Whether the words beside a line cover less at its lower end.
bool has_more_room_below(const Chart& chart, const ChartRanges& ranges, const VerticalLine& line) {
    constexpr double near = 0.05;  // of the width of the chart
    const auto fraction = [](const AxisRange& range, double value) {
        return (range.place(value) - range.low) / (range.high - range.low);
    };
    double low = 1.0;
    double high = 0.0;
    for (const ChartSeries& series : chart.series) {
        for (std::size_t k = 0; k < std::min(series.x.size(), series.y.size()); ++k) {
            if (!(std::abs(fraction(ranges.x, series.x[k]) - fraction(ranges.x, line.x)) < near)) {
                continue;
            }
            const bool has_ends = !series.low.empty();
            low = std::min(low, fraction(ranges.y, has_ends ? series.low[k] : series.y[k]));
            high = std::max(high, fraction(ranges.y, has_ends ? series.high[k] : series.y[k]));
        }
    }
    return low > 1.0 - high;
}

float width_of(vtkContext2D* painter, vtkTextProperty* property, const std::string& text) {
    property->SetOrientation(0.0);
    painter->ApplyTextProp(property);
    std::array<float, 4> box{};  // x, y, width, height
    painter->ComputeStringBounds(text.c_str(), box.data());
    return box[2];
}

}  // namespace

vtkStandardNewMacro(NotesPlot)

    void NotesPlot::describe(const Chart& chart,
                             const ChartRanges& ranges,
                             int font_size,
                             float size) {
    chart_.vertical_lines = chart.vertical_lines;
    is_below_.clear();
    for (const VerticalLine& line : chart.vertical_lines) {
        is_below_.push_back(has_more_room_below(chart, ranges, line));
    }
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
    for (std::size_t k = 0; k < chart_.vertical_lines.size(); ++k) {
        const VerticalLine& line = chart_.vertical_lines[k];
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
        const float end =
            is_below_[k] ? bottom + gap + width_of(painter, text, line.text) : top - gap;
        text->SetOrientation(90.0);
        text->SetJustificationToRight();
        paint_text(painter, text, {x - gap, end}, line.text);
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
        const auto steps = static_cast<int>((top - bottom) / text_height);
        for (int k = 0; k <= steps; ++k) {
            const float y = bottom + static_cast<float>(k) * text_height;
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
