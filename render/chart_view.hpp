/// A chart as VTK draws it: vtkChartXY with our series, in a renderer of its own. Internal to
/// render: shows VTK.
#pragma once

#include "render/chart.hpp"
#include "render/chart_notes.hpp"
#include "render/chart_plot.hpp"
#include "render/chart_scale.hpp"
#include "render/offscreen.hpp"

#include <vtkChartXY.h>
#include <vtkContextActor.h>
#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <filesystem>
#include <vector>

namespace grainbench::render {

class ChartView {
public:
    /// Puts the chart into the window of `offscreen`, which must outlive the view.
    ChartView(const Chart& chart, Offscreen& offscreen);
    ~ChartView();
    ChartView(const ChartView&) = delete;
    ChartView& operator=(const ChartView&) = delete;

    Image draw();

    /// What draw() drew, as text of an SVG file.
    /// \param scratch a file name that is free to be used
    std::string svg(const std::filesystem::path& scratch, const std::string& description);

private:
    void lay_out();
    void style_axes();
    void style_axis(int index, const AxisRange& range, const std::vector<Tick>& ticks);
    void add_series();
    void add_titles();
    void place_legend();

    const Chart& chart_;
    ChartRanges ranges_;
    float size_;  ///< of text and lines; 1 for the usual width
    Offscreen& offscreen_;
    vtkNew<vtkRenderer> renderer_;
    vtkNew<vtkContextActor> actor_;
    vtkNew<vtkChartXY> view_;
    std::vector<vtkSmartPointer<SeriesPlot>> plots_;
    vtkNew<NotesPlot> notes_;
};

}  // namespace grainbench::render
