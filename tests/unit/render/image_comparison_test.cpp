/// Likeness of pictures.
#include "render/image_comparison.hpp"

#include "core/error.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace grainbench::render {
namespace {

Image waves(ImageSize size, int shift) {
    Image image = blank_image(size, 0);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            for (int c = 0; c < 3; ++c) {
                const auto k = static_cast<std::size_t>(3 * (y * size.width + x) + c);
                image.rgb[k] = static_cast<std::uint8_t>(
                    128.0 + 100.0 * std::sin(0.7 * (x + shift) + 0.3 * y + c));
            }
        }
    }
    return image;
}

TEST(CompareImages, SameIsOne) {
    const ImageComparison same = compare_images(waves({31, 20}, 0), waves({31, 20}, 0));
    EXPECT_EQ(same.similarity, 1.0);
    EXPECT_EQ(same.differing_pixels, 0U);
    EXPECT_EQ(similarity_in_words(same), "the same, pixel by pixel");
}

TEST(CompareImages, FlatImagesFollowTheFormulaOfTheirMeans) {
    // Without contrast, SSIM = (2 a b + C1) / (a^2 + b^2 + C1), with C1 = (0.01 255)^2.
    const ImageComparison flat =
        compare_images(blank_image({40, 30}, 100), blank_image({40, 30}, 50));
    const double c1 = 2.55 * 2.55;
    // Round-off of some 100 sums of 11 terms.
    EXPECT_NEAR(flat.similarity, (2.0 * 100 * 50 + c1) / (100 * 100 + 50 * 50 + c1), 1e-9);
    EXPECT_EQ(flat.differing_pixels, 1200U);
}

TEST(CompareImages, NegativeIsBelowZero) {
    Image negative = waves({40, 40}, 0);
    for (std::uint8_t& value : negative.rgb) {
        value = static_cast<std::uint8_t>(255 - value);
    }
    EXPECT_LT(compare_images(waves({40, 40}, 0), negative).similarity, 0.0);
}

TEST(CompareImages, FindsThePlaceThatDiffers) {
    const Image before = waves({200, 100}, 0);
    Image after = before;
    for (int y = 60; y < 70; ++y) {
        for (int x = 150; x < 160; ++x) {
            after.rgb[static_cast<std::size_t>(3 * (y * 200 + x))] = 0;
        }
    }
    const ImageComparison found = compare_images(before, after);
    EXPECT_LT(found.similarity, 1.0);
    EXPECT_GT(found.similarity, 0.97);
    EXPECT_NEAR(found.lowest_x, 155, 10);
    EXPECT_NEAR(found.lowest_y, 65, 10);
    EXPECT_EQ(found.difference.size, before.size);
}

TEST(CompareImages, OnePixelIsEnough) {
    EXPECT_LT(compare_images(blank_image({1, 1}, 0), blank_image({1, 1}, 255)).similarity, 0.01);
}

TEST(CompareImages, OtherSizeIsRefused) {
    EXPECT_THROW(compare_images(blank_image({2, 1}, 0), blank_image({1, 2}, 0)), Error);
}

}  // namespace
}  // namespace grainbench::render
