#include "render/overlay.hpp"

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>

namespace grainbench::render {
namespace {

/// Fonts have sizes in points, which at this resolution are pixels.
constexpr int dots_per_inch = 72;

unsigned char byte_of(double share) {
    return static_cast<unsigned char>(std::lround(255.0 * share));
}

void set_font(vtkTextProperty* property, const Font& font) {
    property->SetFontFamilyToArial();
    property->SetFontSize(static_cast<int>(std::lround(font.size)));
    property->SetBold(font.is_bold ? 1 : 0);
    property->SetItalic(0);
    property->SetShadow(0);
    property->SetColor(font.colour.red, font.colour.green, font.colour.blue);
}

}  // namespace

TextExtent extent_of(const std::string& line, const Font& font) {
    vtkNew<vtkTextProperty> property;
    set_font(property, font);
    std::array<int, 4> box{};  // first and last pixel in x, then in y
    vtkTextRenderer::GetInstance()->GetBoundingBox(property, line, box.data(), dots_per_inch);
    return {static_cast<double>(box[1] - box[0] + 1), 1.2 * font.size};
}

void Overlay::add_text(
    const std::string& line, const Font& font, double x, double bottom, Justify justify) {
    if (line.empty()) {
        return;
    }
    vtkNew<vtkTextActor> actor;
    actor->SetInput(line.c_str());
    set_font(actor->GetTextProperty(), font);
    const double share = justify == Justify::left ? 0.0 : justify == Justify::centre ? 0.5 : 1.0;
    actor->GetTextProperty()->SetJustificationToLeft();
    // Stands on its base line, so that lines without descenders stand as high as others.
    actor->GetTextProperty()->SetVerticalJustificationToBottom();
    actor->SetTextScaleModeToNone();
    actor->SetPosition(std::round(x - share * extent_of(line, font).width), std::round(bottom));
    renderer_->AddActor2D(actor);
}

void Overlay::add_box(
    double left, double bottom, double width, double height, const Colour& colour) {
    add_ladder(left, bottom, width, height, {colour});
}

void Overlay::add_ladder(
    double left, double bottom, double width, double height, const std::vector<Colour>& colours) {
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> cells;
    vtkNew<vtkUnsignedCharArray> paint;
    paint->SetNumberOfComponents(3);
    const double step = height / static_cast<double>(colours.size());
    for (std::size_t k = 0; k < colours.size(); ++k) {
        const double low = bottom + step * static_cast<double>(k);
        const vtkIdType first = points->InsertNextPoint(left, low, 0.0);
        points->InsertNextPoint(left + width, low, 0.0);
        points->InsertNextPoint(left + width, low + step, 0.0);
        points->InsertNextPoint(left, low + step, 0.0);
        cells->InsertNextCell({first, first + 1, first + 2, first + 3});
        paint->InsertNextTuple3(
            byte_of(colours[k].red), byte_of(colours[k].green), byte_of(colours[k].blue));
    }
    vtkNew<vtkPolyData> boxes;
    boxes->SetPoints(points);
    boxes->SetPolys(cells);
    boxes->GetCellData()->SetScalars(paint);
    vtkNew<vtkPolyDataMapper2D> mapper;
    mapper->SetInputData(boxes);
    vtkNew<vtkActor2D> actor;
    actor->SetMapper(mapper);
    renderer_->AddActor2D(actor);
}

}  // namespace grainbench::render
