#include "render/chart_view.hpp"

#include "io/atomic_file.hpp"

#include <fmt/format.h>
#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkChartLegend.h>
#include <vtkContext2D.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkPen.h>
#include <vtkRenderWindow.h>
#include <vtkSVGExporter.h>
#include <vtkStringArray.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace grainbench::render {
namespace {

constexpr float usual_width = 1200.0F;
constexpr float title_font = 24.0F;
constexpr float axis_font = 22.0F;
constexpr float label_font = 19.0F;
constexpr float edge = 14.0F;  // empty space around everything
constexpr int samples = 4;     // of each pixel: smooth edges of lines

int font_size(float points, float size) {
    return std::max(1, static_cast<int>(std::lround(points * size)));
}

std::string axis_title(const ChartAxis& axis) {
    const bool has_unit = !axis.unit.empty() && axis.unit != "1";
    return has_unit ? axis.label + " [" + axis.unit + "]" : axis.label;
}

/// Mends what the exporter of VTK 9.1 gets wrong: it leaves out the clip rectangle that it refers
/// to (and would turn it upside down), and draws what shall have no outline with dashes of length
/// zero, which show as dots.
/// \param lower left lower corner of the axes, in pixels from the lower left of the page
std::string mended(std::string svg,
                   const vtkVector2f& lower,
                   const vtkVector2f& upper,
                   int page_height) {
    const std::string start_of_body = "<g ";
    if (svg.find("<clipPath") == std::string::npos) {
        svg.insert(
            svg.find(start_of_body),
            fmt::format("<defs><clipPath id=\"vtkClipRect1\"><rect x=\"{:.0f}\" y=\"{:.0f}\" "
                        "width=\"{:.0f}\" height=\"{:.0f}\"/></clipPath></defs>\n  ",
                        lower[0],
                        static_cast<float>(page_height) - upper[1],
                        upper[0] - lower[0],
                        upper[1] - lower[1]));
    }
    const std::string dots = "stroke-dasharray=\"0,10\"";
    for (std::size_t at = svg.find(dots); at != std::string::npos; at = svg.find(dots, at)) {
        svg.replace(at, dots.size(), "stroke-opacity=\"0\"");
    }
    return svg;
}

}  // namespace

ChartView::ChartView(const Chart& chart, Offscreen& offscreen)
    : chart_(chart),
      ranges_(ranges_of(chart)),
      size_(static_cast<float>(chart.width) / usual_width),
      offscreen_(offscreen) {
    renderer_->SetBackground(1.0, 1.0, 1.0);
    renderer_->AddActor(actor_);
    actor_->GetScene()->SetRenderer(renderer_);
    actor_->GetScene()->AddItem(view_);
    offscreen_.window()->AddRenderer(renderer_);
    offscreen_.window()->SetSize(chart.width, chart.height);
    offscreen_.window()->SetMultiSamples(samples);
    lay_out();
    add_series();
    style_axes();
    offscreen_.window()->Render();  // lays out the axes
    place_legend();
    add_titles();
}

ChartView::~ChartView() {
    offscreen_.window()->SetMultiSamples(0);
    offscreen_.window()->RemoveRenderer(renderer_);
}

Image ChartView::draw() {
    return offscreen_.draw({chart_.width, chart_.height});
}

std::string ChartView::svg(const std::filesystem::path& scratch, const std::string& description) {
    const vtkNew<vtkSVGExporter> exporter;
    exporter->SetRenderWindow(offscreen_.window());
    exporter->SetActiveRenderer(renderer_);
    exporter->SetTitle(chart_.title.empty() ? chart_.y.label.c_str() : chart_.title.c_str());
    exporter->SetDescription(description.c_str());
    exporter->SetFileName(scratch.c_str());
    exporter->Write();
    std::string text = io::read_file(scratch);
    io::remove_file(scratch);
    return mended(std::move(text),
                  view_->GetAxis(vtkAxis::BOTTOM)->GetPosition1(),
                  {view_->GetAxis(vtkAxis::BOTTOM)->GetPosition2()[0],
                   view_->GetAxis(vtkAxis::LEFT)->GetPosition2()[1]},
                  chart_.height);
}

/// Leaves room for the titles; the chart lays out its axes and numbers in the rest.
void ChartView::lay_out() {
    const float left = (edge + axis_font) * size_;
    const float bottom = (edge + axis_font) * size_;
    const float top = (chart_.title.empty() ? 0.0F : edge + title_font) * size_;
    const auto width = static_cast<float>(chart_.width);
    const auto height = static_cast<float>(chart_.height);
    view_->SetLayoutStrategy(vtkChart::FILL_RECT);
    view_->SetSize({left, bottom, width - left, height - bottom - top});
    view_->SetHiddenAxisBorder(font_size(2.0F * edge, size_));
}

void ChartView::add_titles() {
    const vtkNew<TitlesItem> titles;
    const auto origin = view_->GetAxis(vtkAxis::BOTTOM)->GetPosition1();
    const auto right = view_->GetAxis(vtkAxis::BOTTOM)->GetPosition2();
    const auto top = view_->GetAxis(vtkAxis::LEFT)->GetPosition2();
    const float middle = 0.5F * (origin[0] + right[0]);
    titles->add({.text = axis_title(chart_.x),
                 .centre = {middle, edge * size_},
                 .turned = 0.0,
                 .font_size = font_size(axis_font, size_),
                 .is_bold = false});
    titles->add({.text = axis_title(chart_.y),
                 .centre = {(edge + axis_font) * size_, 0.5F * (origin[1] + top[1])},
                 .turned = 90.0,
                 .font_size = font_size(axis_font, size_),
                 .is_bold = false});
    titles->add(
        {.text = chart_.title,
         .centre = {middle, static_cast<float>(chart_.height) - (edge + 1.2F * title_font) * size_},
         .turned = 0.0,
         .font_size = font_size(title_font, size_),
         .is_bold = true});
    actor_->GetScene()->AddItem(titles);
}

void ChartView::add_series() {
    const auto bar_slots = static_cast<int>(
        std::count_if(chart_.series.begin(), chart_.series.end(), [](const ChartSeries& series) {
            return series.kind == SeriesKind::bars;
        }));
    const SeriesPlot::Setting setting{.ranges = ranges_,
                                      .bar_slots = bar_slots,
                                      .is_alone = chart_.series.size() == 1,
                                      .size = size_};
    const auto add = [&](SeriesPlot::Part part, std::size_t k, int bar_slot) {
        const ChartSeries& series = chart_.series[k];
        auto plot = vtkSmartPointer<SeriesPlot>::New();
        const ChartLook look = chart_look(series.look.value_or(k));
        plot->describe(part, series, look, bar_slot, setting);
        view_->AddPlot(plot);
        return plot;
    };
    for (std::size_t k = 0; k < chart_.series.size(); ++k) {
        if (chart_.series[k].kind == SeriesKind::band) {
            add(SeriesPlot::Part::shade, k, 0);
        }
    }
    int bar_slot = 0;
    for (std::size_t k = 0; k < chart_.series.size(); ++k) {
        plots_.push_back(add(SeriesPlot::Part::strokes, k, bar_slot));
        bar_slot += chart_.series[k].kind == SeriesKind::bars ? 1 : 0;
    }
    notes_->describe(chart_, ranges_, font_size(label_font, size_), size_);
    view_->AddPlot(notes_);
}

void ChartView::style_axes() {
    const int across = std::max(2, chart_.width / static_cast<int>(130.0F * size_));
    const int along = std::max(2, chart_.height / static_cast<int>(90.0F * size_));
    style_axis(
        vtkAxis::BOTTOM,
        ranges_.x,
        chart_.categories.empty() ? ticks_of(ranges_.x, across) : ticks_of(chart_.categories));
    style_axis(vtkAxis::LEFT, ranges_.y, ticks_of(ranges_.y, along));
    view_->GetAxis(vtkAxis::BOTTOM)->SetGridVisible(chart_.categories.empty());
}

void ChartView::style_axis(int index, const AxisRange& range, const std::vector<Tick>& ticks) {
    vtkAxis* target = view_->GetAxis(index);
    target->SetTitle("");
    target->GetLabelProperties()->SetFontSize(font_size(label_font, size_));
    target->SetBehavior(vtkAxis::FIXED);
    target->SetRange(range.low, range.high);
    target->SetTickLength(std::round(7.0F * size_));
    target->SetLabelOffset(std::round(11.0F * size_));  // text off the pixels is blurred
    target->GetPen()->SetWidth(1.5F * size_);
    target->GetGridPen()->SetColor(225, 225, 225, 255);
    target->GetGridPen()->SetWidth(1.0F * size_);
    const vtkNew<vtkDoubleArray> places;
    const vtkNew<vtkStringArray> labels;
    for (const Tick& tick : ticks) {
        places->InsertNextValue(tick.place);
        labels->InsertNextValue(tick.label);
    }
    target->SetCustomTickPositions(places, labels);
}

/// Inside the axes where it covers no data, else to the right of them. What a single series is, the
/// titles say.
void ChartView::place_legend() {
    const auto named =
        std::count_if(chart_.series.begin(), chart_.series.end(), [](const ChartSeries& series) {
            return !series.name.empty();
        });
    if (named == 0 || chart_.series.size() == 1) {
        return;
    }
    view_->SetShowLegend(true);
    vtkChartLegend* legend = view_->GetLegend();
    legend->SetLabelSize(font_size(label_font, size_));
    legend->SetSymbolWidth(font_size(62.0F, size_));
    legend->SetPadding(font_size(8.0F, size_));
    legend->GetPen()->SetColor(150, 150, 150, 255);
    legend->GetBrush()->SetColor(255, 255, 255, 255);
    legend->SetInline(true);
    offscreen_.window()->Render();  // lays out axes and legend

    std::vector<Pixel> covered = notes_->covered();
    for (const auto& plot : plots_) {
        const std::vector<Pixel> points = plot->covered();
        covered.insert(covered.end(), points.begin(), points.end());
    }
    const vtkRectf box = legend->GetBoundingRect(actor_->GetContext());
    const float margin = 8.0F * size_;
    const auto left = view_->GetAxis(vtkAxis::BOTTOM)->GetPosition1();
    const auto right = view_->GetAxis(vtkAxis::BOTTOM)->GetPosition2();
    const auto top = view_->GetAxis(vtkAxis::LEFT)->GetPosition2();

    struct Place {
        int horizontal, vertical;
    };

    for (const Place place : {Place{vtkChartLegend::RIGHT, vtkChartLegend::TOP},
                              Place{vtkChartLegend::LEFT, vtkChartLegend::TOP},
                              Place{vtkChartLegend::RIGHT, vtkChartLegend::BOTTOM},
                              Place{vtkChartLegend::LEFT, vtkChartLegend::BOTTOM}}) {
        const float x0 = place.horizontal == vtkChartLegend::LEFT
                             ? left[0] + margin
                             : right[0] - margin - box.GetWidth();
        const float y0 = place.vertical == vtkChartLegend::BOTTOM
                             ? left[1] + margin
                             : top[1] - margin - box.GetHeight();
        const bool is_free = std::none_of(covered.begin(), covered.end(), [&](const Pixel& p) {
            return p[0] >= x0 - margin && p[0] <= x0 + box.GetWidth() + margin &&
                   p[1] >= y0 - margin && p[1] <= y0 + box.GetHeight() + margin;
        });
        if (is_free) {
            legend->SetHorizontalAlignment(vtkChartLegend::CUSTOM);
            legend->SetVerticalAlignment(vtkChartLegend::CUSTOM);
            legend->SetPoint(x0, y0);
            return;
        }
    }
    legend->SetInline(false);
    legend->SetHorizontalAlignment(vtkChartLegend::RIGHT);
    legend->SetVerticalAlignment(vtkChartLegend::TOP);
}

}  // namespace grainbench::render
