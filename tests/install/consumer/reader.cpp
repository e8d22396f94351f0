// Uses the component io of the installed package: prints the title of a scene and its wall count.
#include "io/json/scene_json.hpp"

#include <cstdio>

int main(int, char** arguments) {
    const grainbench::Scene scene = grainbench::io::read_scene(arguments[1]);
    std::printf("%s: %zu walls\n", scene.title.c_str(), scene.walls.size());
}
