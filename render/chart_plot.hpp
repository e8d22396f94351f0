/// One series of a chart, drawn in pixels. Internal to render: shows VTK.
///
/// VTK's own plots hand their points in the units of the data to the painter and let a matrix scale
/// them. The SVG exporter of VTK 9.1 flips such points at the height of the page before that matrix
/// is applied, writes them with six digits, and scales dashes and markers with them: lines end up
/// outside the page (share/doc/decisions). Points that are in pixels before they reach the painter
/// come out right from both of its devices.
#pragma once

#include "render/chart.hpp"
#include "render/chart_drawing.hpp"
#include "render/chart_scale.hpp"

#include <vtkPlot.h>

#include <vector>

namespace grainbench::render {

class SeriesPlot : public vtkPlot {
public:
    vtkTypeMacro(SeriesPlot, vtkPlot) static SeriesPlot* New();
    SeriesPlot(const SeriesPlot&) = delete;
    void operator=(const SeriesPlot&) = delete;

    /// Shades of all bands lie below all lines, so they are plots of their own.
    enum class Part { shade, strokes };

    /// What a series shares with others of its chart.
    struct Setting {
        ChartRanges ranges;
        int bar_slots = 1;      ///< bars at each category
        bool is_alone = false;  ///< no other series: a line needs no markers to be told apart
        float size = 1.0F;      ///< of lines, markers and gaps; 1 for the usual width of a chart
    };

    /// \param bar_slot which of the bars at a category this is
    void describe(Part part,
                  const ChartSeries& series,
                  const ChartLook& look,
                  int bar_slot,
                  const Setting& setting);

    bool Paint(vtkContext2D* painter) override;
    bool PaintLegend(vtkContext2D* painter, const vtkRectf& rect, int index) override;

    /// Where the series covers the chart, in pixels, close enough to keep a legend off it.
    std::vector<Pixel> covered() const;

protected:
    SeriesPlot() = default;
    ~SeriesPlot() override = default;

private:
    Pixel pixel_of(double x, double y) const;
    double bar_place(std::size_t category) const;
    double across(std::size_t k) const;
    std::vector<std::vector<Pixel>> strokes() const;

    void paint_band(vtkContext2D* painter) const;
    void paint_line(vtkContext2D* painter) const;
    void paint_markers(vtkContext2D* painter, const std::vector<Pixel>& points) const;
    void paint_error_bars(vtkContext2D* painter) const;
    void paint_bars(vtkContext2D* painter) const;
    void paint_bar(vtkContext2D* painter, Pixel low, Pixel high) const;
    void use_line(vtkContext2D* painter, bool is_dashed) const;

    Part part_ = Part::strokes;
    ChartSeries series_;
    ChartLook look_{};
    int bar_slot_ = 0;
    Setting setting_;
};

}  // namespace grainbench::render
