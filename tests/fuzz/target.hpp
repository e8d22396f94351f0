/// A fuzz target hands bytes to a reader of files. Whatever they are, the reader takes them or
/// throws an Error; any other exception, and whatever the sanitizers see, is a fault of ours.
///
/// Each target is built twice: with libFuzzer and clang (GRAINBENCH_FUZZ, share/fuzz.sh), which
/// looks for such bytes, and with replay.cpp as an ordinary test, which tries those of corpus/
/// again.
#pragma once

#include "core/error.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace grainbench::fuzz {

/// A file of this process, for readers that take a path.
class InputFile {
public:
    explicit InputFile(const std::string& name);
    ~InputFile();

    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    void write(std::string_view bytes) const;

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path folder_;
    std::filesystem::path path_;
};

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

/// Calls read(); an Error is an answer like any other.
template <class Read>
void attempt(const Read& read) {
    try {
        read();
    } catch (const Error&) {
    }
}

}  // namespace grainbench::fuzz
