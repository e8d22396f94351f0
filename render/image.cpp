#include "render/image.hpp"

#include "core/error.hpp"

#include "io/atomic_file.hpp"
#include "io/vtk/session.hpp"

#include <png.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

#include <cstring>
#include <stdexcept>

namespace grainbench::render {
namespace {

/// Writing fast weighs more than the last percents of size.
constexpr int compression_level = 3;

[[noreturn]] void throw_damaged(const std::filesystem::path& path, const std::string& reason) {
    throw_input_output({.what = "cannot read a PNG file: " + reason,
                        .where = path.string(),
                        .likely_cause = "the file is damaged, or no PNG file",
                        .next_step = "write the file anew"});
}

/// Copies rows from the top to rows from the bottom.
void flip_rows(const std::uint8_t* from, std::uint8_t* to, ImageSize size) {
    const auto row_size = 3 * static_cast<std::size_t>(size.width);
    const auto rows = static_cast<std::size_t>(size.height);
    for (std::size_t row = 0; row < rows; ++row) {
        std::memcpy(to + (rows - 1 - row) * row_size, from + row * row_size, row_size);
    }
}

}  // namespace

Image blank_image(ImageSize size, std::uint8_t grey) {
    const auto pixels =
        static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
    return {size, std::vector<std::uint8_t>(3 * pixels, grey)};
}

std::string encode_png(const Image& image, const ImageText& text) {
    const io::VtkSession session;
    vtkNew<vtkImageData> data;
    data->SetDimensions(image.size.width, image.size.height, 1);
    data->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    flip_rows(image.rgb.data(), static_cast<std::uint8_t*>(data->GetScalarPointer()), image.size);
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputData(data);
    writer->SetCompressionLevel(compression_level);
    for (const auto& [keyword, value] : text) {
        writer->AddText(keyword.c_str(), value.c_str());
    }
    writer->WriteToMemoryOn();
    writer->Write();
    if (!session.error().empty()) {
        throw std::runtime_error("cannot encode a PNG file: " + session.error());
    }
    vtkUnsignedCharArray* bytes = writer->GetResult();
    return {reinterpret_cast<const char*>(bytes->GetPointer(0)),
            static_cast<std::size_t>(bytes->GetNumberOfValues())};
}

void write_png(const std::filesystem::path& path, const Image& image, const ImageText& text) {
    io::write_file(path, encode_png(image, text));
}

Image read_png(const std::filesystem::path& path) {
    const std::string bytes = io::read_file(path);
    // libpng itself: VTK's reader crashes on a truncated file.
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0) {
        throw_damaged(path, png.message);
    }
    png.format = PNG_FORMAT_RGB;
    Image image = blank_image({static_cast<int>(png.width), static_cast<int>(png.height)}, 0);
    constexpr png_color white{255, 255, 255};
    if (png_image_finish_read(&png, &white, image.rgb.data(), 0, nullptr) == 0) {
        throw_damaged(path, png.message);
    }
    return image;
}

}  // namespace grainbench::render
