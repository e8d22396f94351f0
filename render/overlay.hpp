/// Texts and flat shapes in front of a picture, in pixels from the lower left. Internal to render:
/// shows VTK.
#pragma once

#include "render/colour_map.hpp"

#include <array>
#include <string>
#include <vector>

class vtkRenderer;

namespace grainbench::render {

enum class Justify { left, centre, right };

struct Font {
    double size = 12.0;  ///< pixels
    bool is_bold = false;
    Colour colour;
};

struct TextExtent {
    double width = 0.0;   ///< pixels
    double height = 0.0;  ///< pixels
};

/// What a line of text takes; the height is that of the font, the same for all lines.
TextExtent extent_of(const std::string& line, const Font& font);

class Overlay {
public:
    explicit Overlay(vtkRenderer* renderer) : renderer_(renderer) {}

    /// \param x, bottom where the line starts, has its middle or ends, and where its box stands
    void add_text(
        const std::string& line, const Font& font, double x, double bottom, Justify justify);

    /// A filled rectangle.
    void add_box(double left, double bottom, double width, double height, const Colour& colour);

    /// Boxes of equal height on top of each other, from the bottom.
    void add_ladder(double left,
                    double bottom,
                    double width,
                    double height,
                    const std::vector<Colour>& colours);

private:
    vtkRenderer* renderer_;
};

}  // namespace grainbench::render
