#include "tests/fuzz/target.hpp"

#include <unistd.h>

#include <fstream>

namespace grainbench::fuzz {

InputFile::InputFile(const std::string& name)
    : folder_(std::filesystem::temp_directory_path() /
              ("grainbench-fuzz-" + std::to_string(::getpid()))),
      path_(folder_ / name) {
    std::filesystem::create_directories(folder_);
}

InputFile::~InputFile() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
}

void InputFile::write(std::string_view bytes) const {
    std::ofstream(path_, std::ios::binary | std::ios::trunc)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace grainbench::fuzz
