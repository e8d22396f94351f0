// Scene JSON: what is read must also be written and read again.
#include "io/json/scene_json.hpp"

#include "tests/fuzz/target.hpp"

#include <cstdlib>

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace grainbench;
    static const fuzz::InputFile folder("scene.json");
    const std::filesystem::path directory = folder.path().parent_path();
    fuzz::attempt([&] {
        const Scene scene = io::parse_scene(fuzz::text_of(data, size), directory, "scene.json");
        const std::string text = io::write_scene(scene, {});
        if (io::write_scene(io::parse_scene(text, directory, "again.json"), {}) != text) {
            std::abort();
        }
    });
    return 0;
}
