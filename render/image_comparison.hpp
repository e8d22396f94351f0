/// How alike two pictures are to the eye: structural similarity (SSIM) of Wang, Bovik, Sheikh and
/// Simoncelli, IEEE Transactions on Image Processing 13 (2004), equation 13, with their constants.
///
/// Around each pixel, a Gaussian window of 11 by 11 pixels (deviation 1.5) compares mean, contrast
/// and pattern of the two pictures; red, green and blue are compared on their own and averaged.
/// 1 means the same, 0 that they have nothing in common, less that one is the negative of the
/// other. Unlike a count of differing pixels it hardly sees noise and shifts of brightness, and
/// does see what moved, is missing or lost its edges.
#pragma once

#include "render/image.hpp"

#include <string>

namespace grainbench::render {

struct ImageComparison {
    double similarity = 1.0;           ///< [1] mean SSIM over all pixels
    double lowest = 1.0;               ///< [1] SSIM where the pictures are least alike
    int lowest_x = 0;                  ///< pixels from the left
    int lowest_y = 0;                  ///< pixels from the top
    std::size_t differing_pixels = 0;  ///< in any colour, by any amount
    Image difference;                  ///< the first picture in pale grey, red where they differ
};

/// Error(bad_input) if the sizes differ.
ImageComparison compare_images(const Image& first, const Image& second);

/// What a mean similarity means in words.
std::string similarity_in_words(const ImageComparison& comparison);

}  // namespace grainbench::render
