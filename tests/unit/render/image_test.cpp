/// Pictures as PNG files.
#include "render/image.hpp"

#include "core/error.hpp"

#include "io/atomic_file.hpp"

#include "tests/unit/io/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <map>

namespace grainbench::render {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

Image checkered(ImageSize size) {
    Image image = blank_image(size, 0);
    for (std::size_t k = 0; k < image.rgb.size(); ++k) {
        image.rgb[k] = static_cast<std::uint8_t>(37 * k);
    }
    return image;
}

TEST(Png, ReadsBackPixelsAndText) {
    const TemporaryFolder folder;
    const Image image = checkered({5, 3});
    write_png(folder / "a.png", image, {{"Software", "grainbench"}, {"Seed", "7"}});
    EXPECT_EQ(read_png(folder / "a.png"), image);
    vtkNew<vtkPNGReader> reader;
    reader->SetFileName((folder / "a.png").c_str());
    reader->Update();
    std::map<std::string, std::string> text;
    for (std::size_t k = 0; k < reader->GetNumberOfTextChunks(); ++k) {
        const int index = static_cast<int>(k);
        text.emplace(reader->GetTextKey(index), reader->GetTextValue(index));
    }
    EXPECT_THAT(text, ElementsAre(Pair("Seed", "7"), Pair("Software", "grainbench")));
}

TEST(Png, SameImageGivesSameBytes) {
    EXPECT_EQ(encode_png(checkered({40, 30}), {{"Seed", "7"}}),
              encode_png(checkered({40, 30}), {{"Seed", "7"}}));
}

TEST(Png, NamesADamagedFile) {
    const TemporaryFolder folder;
    const std::string whole = encode_png(checkered({40, 30}), {});
    for (const std::string& bytes :
         {std::string(), std::string("no picture"), whole.substr(0, 60)}) {
        io::write_file(folder / "b.png", bytes);
        try {
            read_png(folder / "b.png");
            FAIL() << bytes.size() << " bytes were taken for a picture";
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input_output);
            EXPECT_THAT(error.what(), HasSubstr("b.png"));
        }
    }
}

}  // namespace
}  // namespace grainbench::render
