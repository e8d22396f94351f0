// A mesh of an STL file, text or binary; a mesh that is read must also become a wall or be refused.
#include "core/walls/surface.hpp"

#include "io/import.hpp"

#include "tests/fuzz/target.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace grainbench;
    static const fuzz::InputFile file("mesh.stl");
    file.write(fuzz::text_of(data, size));
    fuzz::attempt([] {
        MeshFile mesh;
        io::read_mesh(file.path(), 0.001, mesh.vertices, mesh.triangles);
        const Surface surface(mesh, "/walls/0");
        std::vector<Index> patches;
        surface.collect(mesh.vertices.front(), 1.0, patches);
    });
    return 0;
}
