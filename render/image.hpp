/// Pictures in memory and as PNG files, with text that says where they come from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace grainbench::render {

struct ImageSize {
    int width = 0;   ///< pixels
    int height = 0;  ///< pixels

    bool operator==(const ImageSize&) const = default;
};

/// Red, green and blue of each pixel, row by row from the top.
struct Image {
    ImageSize size;
    std::vector<std::uint8_t> rgb;

    bool operator==(const Image&) const = default;
};

/// An image of one colour.
Image blank_image(ImageSize size, std::uint8_t grey);

/// Keywords and texts of a PNG file; the same keyword may stand once.
using ImageText = std::vector<std::pair<std::string, std::string>>;

/// Bytes of a PNG file. The same image and text give the same bytes.
std::string encode_png(const Image& image, const ImageText& text);

/// Writes a PNG file, all or nothing.
void write_png(const std::filesystem::path& path, const Image& image, const ImageText& text);

/// Reads a PNG file; grey, palettes and 16 bits become 8-bit colour, transparency shows white.
/// Error(input_output) that names the file if it is missing or damaged.
Image read_png(const std::filesystem::path& path);

}  // namespace grainbench::render
