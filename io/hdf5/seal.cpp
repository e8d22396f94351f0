#include "io/hdf5/seal.hpp"

#include "io/hdf5/handle.hpp"
#include "io/text.hpp"

#include <algorithm>
#include <utility>

namespace grainbench::io {
namespace {

// HDF5 allows 512 bytes (or twice, four times that ...) of anything in front of its data.
constexpr std::size_t seal_size = 512;

}  // namespace

std::string seal_of(const std::string& format, std::string_view bytes) {
    std::string seal = format + "\nfnv1a " + to_hex(fnv1a(bytes)) + "\n";
    seal.resize(seal_size, '\0');
    return seal;
}

std::string unsealed(const std::string& format, std::string bytes) {
    if (bytes.compare(0, format.size() + 1, format + "\n") != 0) {
        throw Hdf5Failure("it is no file of the format " + format);
    }
    const std::string_view all = bytes;
    const std::string_view content = all.substr(std::min(all.size(), seal_size));
    if (all.substr(0, seal_size) != seal_of(format, content)) {
        throw Hdf5Failure("its bytes differ from those that were written");
    }
    bytes.erase(0, seal_size);
    return bytes;
}

}  // namespace grainbench::io
