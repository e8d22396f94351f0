// Hands each file of the folders named to the fuzz target, for compilers without libFuzzer.
#include "io/atomic_file.hpp"

#include "tests/fuzz/target.hpp"

#include <algorithm>
#include <cstdio>
#include <vector>

int main(int argc, char** argv) {
    std::vector<std::filesystem::path> files;
    for (int n = 1; n < argc; ++n) {
        for (const auto& entry : std::filesystem::directory_iterator(argv[n])) {
            files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end());
    for (const std::filesystem::path& file : files) {
        const std::string bytes = grainbench::io::read_file(file);
        std::printf("%s\n", file.filename().c_str());
        std::fflush(stdout);  // so that the last line names what crashed
        LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    }
    return files.empty() ? 1 : 0;
}
