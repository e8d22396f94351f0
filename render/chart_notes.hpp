/// Words on a chart: titles, vertical lines and notes. Internal to render: shows VTK.
#pragma once

#include "render/chart.hpp"
#include "render/chart_drawing.hpp"
#include "render/chart_scale.hpp"

#include <vtkContextItem.h>
#include <vtkPlot.h>

#include <string>
#include <utility>
#include <vector>

class vtkTextProperty;

namespace grainbench::render {

/// Vertical lines and texts of a chart, in pixels.
class NotesPlot : public vtkPlot {
public:
    vtkTypeMacro(NotesPlot, vtkPlot) static NotesPlot* New();
    NotesPlot(const NotesPlot&) = delete;
    void operator=(const NotesPlot&) = delete;

    void describe(const Chart& chart, const ChartRanges& ranges, int font_size, float size);

    bool Paint(vtkContext2D* painter) override;

    /// Where the lines and the words beside them are, in pixels.
    std::vector<Pixel> covered() const;

protected:
    NotesPlot() = default;
    ~NotesPlot() override = default;

private:
    void paint_text(vtkContext2D* painter,
                    vtkTextProperty* property,
                    Pixel corner,
                    const std::string& text) const;

    Chart chart_;
    ChartRanges ranges_;
    std::vector<bool> is_below_;  ///< where the words of each vertical line stand
    int font_size_ = 12;
    float size_ = 1.0F;
};

/// Titles of the chart and of its axes. vtkAxis would set its title ten pixels from the numbers,
/// whatever the size of either.
class TitlesItem : public vtkContextItem {
public:
    vtkTypeMacro(TitlesItem, vtkContextItem) static TitlesItem* New();
    TitlesItem(const TitlesItem&) = delete;
    void operator=(const TitlesItem&) = delete;

    struct Title {
        std::string text;
        Pixel centre;         ///< of its lower edge
        double turned = 0.0;  ///< [degrees]
        int font_size = 12;
        bool is_bold = false;
    };

    void add(Title title) { titles_.push_back(std::move(title)); }

    bool Paint(vtkContext2D* painter) override;

protected:
    TitlesItem() = default;
    ~TitlesItem() override = default;

private:
    std::vector<Title> titles_;
};

}  // namespace grainbench::render
