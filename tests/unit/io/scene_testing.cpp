#include "tests/unit/io/scene_testing.hpp"

#include "io/json/scene_json.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace grainbench::testing_support {

namespace fs = std::filesystem;

namespace {

const fs::path source_folder = GRAINBENCH_SOURCE_DIR;

}  // namespace

std::vector<fs::path> preset_files() {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(source_folder / "presets" / "scenes")) {
        files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

fs::path preset(const std::string& name) {
    return source_folder / "presets" / "scenes" / name;
}

std::string text_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    EXPECT_TRUE(stream.good()) << file;
    std::ostringstream text;
    text << stream.rdbuf();
    return std::move(text).str();
}

void write_text(const fs::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

fs::path test_folder() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    const fs::path folder =
        fs::path(testing::TempDir()) / (std::string(info->test_suite_name()) + "." + info->name());
    fs::remove_all(folder);
    fs::create_directories(folder);
    return folder;
}

Json every_key() {
    static const Json document =
        Json::parse(text_of(source_folder / "tests" / "unit" / "io" / "every_key.json"));
    return document;
}

fs::path import_folder() {
    fs::path folder = test_folder();
    write_text(folder / "spheres.csv", "x,y,z\n0.5,0.5,0.5\n");
    write_text(folder / "hull.stl",
               "solid hull\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
               "vertex 0 1 0\nendloop\nendfacet\nendsolid hull\n");
    return folder;
}

Json smallest_scene() {
    return Json::parse(R"({
        "format": "grainbench-scene/1",
        "particles": {"species": [{"name": "ball", "radius": 0.01, "density": 1000}]},
        "contact": {"stiffness": {"law": "constant_stiffness", "normal": 1e5},
                    "normal": {"law": "linear_spring"}},
        "stages": [{"duration": 1}]})");
}

std::optional<Error> error_of(const std::string& text, const fs::path& folder) {
    try {
        io::parse_scene(text, folder, "test.json");
    } catch (const Error& error) {
        return error;
    }
    return std::nullopt;
}

std::optional<Error> error_of(const Json& document) {
    return error_of(document.dump(), testing::TempDir());
}

std::optional<Error> error_of_preset(const std::string& name,
                                     const std::vector<std::string>& overrides) {
    try {
        io::read_scene(preset(name), overrides);
    } catch (const Error& error) {
        return error;
    }
    return std::nullopt;
}

}  // namespace grainbench::testing_support
