/// Colours, the same in every figure: palettes for things that are counted (layers, species,
/// groups, lines of a plot) and maps for fields. All can be told apart with impaired colour vision.
#pragma once

#include "core/describe.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>

namespace grainbench {

namespace render {

struct Colour {
    double red = 0.0;    ///< [1] 0 to 1, as all three
    double green = 0.0;  ///< [1]
    double blue = 0.0;   ///< [1]

    bool operator==(const Colour&) const = default;
};

/// 0xRRGGBB, as colours are written on the web.
constexpr Colour colour_of(std::uint32_t code) {
    return {((code >> 16U) & 255U) / 255.0, ((code >> 8U) & 255U) / 255.0, (code & 255U) / 255.0};
}

/// Maps from dark to light with even steps to the eye.
enum class ColourMap { viridis, cividis, batlow };

/// \param fraction of the range, 0 to 1; values outside give the end of the map
Colour map_colour(ColourMap map, double fraction);

/// Colour of layer 1, 2, ...; a light grey for 0, which is no layer. Eight differ, then they
/// repeat.
Colour layer_colour(std::int32_t layer);

/// Colour of the species with this index.
Colour species_colour(std::int32_t species);

/// Colour of group 1, 2, ...; a light grey for 0, which is no group. Group 1 looks as species 0
/// does, since groups mostly follow species.
Colour group_colour(std::int32_t group);

/// Colour of line 0, 1, ... of a plot, on a light or a dark background.
Colour line_colour(std::size_t line, bool is_background_dark);

}  // namespace render

template <>
struct EnumNames<render::ColourMap> {
    static constexpr std::array<std::pair<render::ColourMap, std::string_view>, 3> value{
        {{render::ColourMap::viridis, "viridis"},
         {render::ColourMap::cividis, "cividis"},
         {render::ColourMap::batlow, "batlow"}}};
};

}  // namespace grainbench
