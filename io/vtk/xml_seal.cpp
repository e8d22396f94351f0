#include "io/vtk/xml_seal.hpp"

#include "io/text.hpp"

#include <string_view>

namespace grainbench::io {
namespace {

constexpr std::string_view opening = "<!-- fnv1a ";
constexpr std::string_view closing = " -->\n";
constexpr std::size_t seal_size = opening.size() + 16 + closing.size();

std::string seal_of(std::string_view content) {
    return std::string(opening) + to_hex(fnv1a(content)) + std::string(closing);
}

}  // namespace

void seal_xml(std::string& bytes) {
    bytes += seal_of(bytes);
}

bool seal_fits(const std::string& bytes) {
    if (bytes.size() < seal_size) {
        return true;
    }
    const std::size_t start = bytes.size() - seal_size;
    const std::string_view seal = std::string_view(bytes).substr(start);
    // Either end marks a seal, so that damage within one of them does not hide it.
    if (!seal.starts_with(opening) && !seal.ends_with(closing)) {
        return true;
    }
    return seal == seal_of(std::string_view(bytes).substr(0, start));
}

}  // namespace grainbench::io
