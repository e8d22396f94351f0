/// Palettes and maps.
#include "render/colour_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace grainbench::render {
namespace {

/// Lightness to the eye, 0 to 1: sRGB to luminance to L* of CIE 1976.
double lightness(const Colour& colour) {
    const auto linear = [](double value) {
        return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
    };
    const double luminance =
        0.2126 * linear(colour.red) + 0.7152 * linear(colour.green) + 0.0722 * linear(colour.blue);
    return luminance > 0.008856 ? 1.16 * std::cbrt(luminance) - 0.16 : 9.033 * luminance;
}

TEST(ColourMap, GetsLighterAllTheWay) {
    for (const auto& [map, name] : EnumNames<ColourMap>::value) {
        double before = -1.0;
        for (int step = 0; step <= 100; ++step) {
            const double now = lightness(map_colour(map, step / 100.0));
            EXPECT_GT(now, before) << name << " at " << step << " %";
            before = now;
        }
    }
}

TEST(ColourMap, EndsWhereItsRangeEnds) {
    const Colour low = colour_of(0x440154);
    const Colour high = colour_of(0xFDE725);
    EXPECT_EQ(map_colour(ColourMap::viridis, 0.0), low);
    EXPECT_EQ(map_colour(ColourMap::viridis, -3.0), low);
    EXPECT_EQ(map_colour(ColourMap::viridis, std::numeric_limits<double>::quiet_NaN()), low);
    EXPECT_EQ(map_colour(ColourMap::viridis, 1.0), high);
    EXPECT_EQ(map_colour(ColourMap::viridis, 1e300), high);
}

TEST(Palette, TellsEightLayersApart) {
    for (std::int32_t i = 0; i <= 8; ++i) {
        for (std::int32_t j = i + 1; j <= 8; ++j) {
            EXPECT_FALSE(layer_colour(i) == layer_colour(j)) << i << " and " << j;
        }
    }
    EXPECT_EQ(layer_colour(9), layer_colour(1));
}

TEST(Palette, GivesGroupsTheColoursOfTheSpeciesTheyFollow) {
    EXPECT_EQ(group_colour(1), species_colour(0));
    EXPECT_EQ(group_colour(2), species_colour(1));
}

}  // namespace
}  // namespace grainbench::render
