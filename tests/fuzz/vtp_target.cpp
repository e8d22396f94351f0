// A VTP file as particles and as a mesh.
#include "io/import.hpp"

#include "tests/fuzz/target.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace grainbench;
    static const fuzz::InputFile file("data.vtp");
    file.write(fuzz::text_of(data, size));
    fuzz::attempt([] { io::read_particles(file.path(), "ball"); });
    fuzz::attempt([] {
        std::vector<Vec3> vertices;
        std::vector<std::array<Index, 3>> triangles;
        io::read_mesh(file.path(), 1.0, vertices, triangles);
    });
    return 0;
}
