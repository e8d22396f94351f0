// Particles of a CSV file.
#include "io/import.hpp"

#include "tests/fuzz/target.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace grainbench;
    static const fuzz::InputFile file("particles.csv");
    file.write(fuzz::text_of(data, size));
    fuzz::attempt([] { io::read_particles(file.path(), "ball"); });
    return 0;
}
