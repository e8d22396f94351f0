#include "render/colour_map.hpp"

#include <algorithm>
#include <cmath>

namespace grainbench::render {
namespace {

// Okabe and Ito, "Color universal design" (2008); grey for their black, which shades like a hole.
constexpr Colour orange = colour_of(0xE69F00);
constexpr Colour sky_blue = colour_of(0x56B4E9);
constexpr Colour bluish_green = colour_of(0x009E73);
constexpr Colour yellow = colour_of(0xF0E442);
constexpr Colour blue = colour_of(0x0072B2);
constexpr Colour vermilion = colour_of(0xD55E00);
constexpr Colour reddish_purple = colour_of(0xCC79A7);
constexpr Colour grey = colour_of(0x7F7F7F);
constexpr Colour none = colour_of(0xD0D0D0);

/// Neighbours differ in lightness as well as in hue.
constexpr std::array layers{
    orange, blue, yellow, reddish_purple, bluish_green, sky_blue, vermilion, grey};

constexpr std::array species{
    sky_blue, vermilion, bluish_green, yellow, reddish_purple, blue, orange, grey};

constexpr std::array lines{blue, vermilion, bluish_green, orange, reddish_purple, sky_blue};
constexpr std::array lines_on_dark{
    sky_blue, orange, bluish_green, yellow, reddish_purple, vermilion};

// Ten colours at even distances of each map, with straight lines in between: the difference from
// the full tables of 256 colours is not seen.
using Samples = std::array<Colour, 10>;

/// matplotlib, van der Walt and Smith (2015).
constexpr Samples viridis{colour_of(0x440154),
                          colour_of(0x482878),
                          colour_of(0x3E4989),
                          colour_of(0x31688E),
                          colour_of(0x26828E),
                          colour_of(0x1F9E89),
                          colour_of(0x35B779),
                          colour_of(0x6ECE58),
                          colour_of(0xB5DE2B),
                          colour_of(0xFDE725)};

/// Nunez, Anderton and Renslow (2018).
constexpr Samples cividis{colour_of(0x00224E),
                          colour_of(0x123570),
                          colour_of(0x3B496C),
                          colour_of(0x575D6D),
                          colour_of(0x707173),
                          colour_of(0x8A8678),
                          colour_of(0xA59C74),
                          colour_of(0xC3B369),
                          colour_of(0xE1CC55),
                          colour_of(0xFEE838)};

/// Crameri, scientific colour maps (2018).
constexpr Samples batlow{colour_of(0x011959),
                         colour_of(0x103F60),
                         colour_of(0x1C5A62),
                         colour_of(0x3C6D56),
                         colour_of(0x687B3E),
                         colour_of(0x9D892B),
                         colour_of(0xD29343),
                         colour_of(0xF8A17B),
                         colour_of(0xFDB7BC),
                         colour_of(0xFACCFA)};

const Samples& samples_of(ColourMap map) {
    switch (map) {
        case ColourMap::cividis:
            return cividis;
        case ColourMap::batlow:
            return batlow;
        case ColourMap::viridis:
            break;
    }
    return viridis;
}

/// Item number `index` of a palette that starts again at its end.
template <class Palette>
Colour pick(const Palette& palette, std::size_t index) {
    return palette[index % palette.size()];
}

}  // namespace

Colour map_colour(ColourMap map, double fraction) {
    const Samples& samples = samples_of(map);
    const double intervals = static_cast<double>(samples.size() - 1);
    // The comparison is false for NaN, which then is drawn as the low end.
    const double place = fraction > 0.0 ? std::min(fraction, 1.0) * intervals : 0.0;
    const std::size_t below = std::min(static_cast<std::size_t>(place), samples.size() - 2);
    const double share = place - static_cast<double>(below);
    const Colour& low = samples[below];
    const Colour& high = samples[below + 1];
    return {std::lerp(low.red, high.red, share),
            std::lerp(low.green, high.green, share),
            std::lerp(low.blue, high.blue, share)};
}

Colour layer_colour(std::int32_t layer) {
    return layer < 1 ? none : pick(layers, static_cast<std::size_t>(layer - 1));
}

Colour species_colour(std::int32_t index) {
    return index < 0 ? none : pick(species, static_cast<std::size_t>(index));
}

Colour group_colour(std::int32_t group) {
    return species_colour(group - 1);
}

Colour line_colour(std::size_t line, bool is_background_dark) {
    return is_background_dark ? pick(lines_on_dark, line) : pick(lines, line);
}

}  // namespace grainbench::render
