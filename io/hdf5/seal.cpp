#include "io/hdf5/seal.hpp"

#include "io/hdf5/handle.hpp"
#include "io/text.hpp"

namespace grainbench::io {
namespace {

// HDF5 allows 512 bytes (or twice, four times that ...) of anything in front of its data.
constexpr std::size_t seal_size = 512;

std::string seal_of(const std::string& format, const std::string& bytes) {
    std::string seal = format + "\nfnv1a " + to_hex(fnv1a(bytes)) + "\n";
    seal.resize(seal_size, '\0');
    return seal;
}

}  // namespace

std::string sealed(const std::string& format, const std::string& bytes) {
    return seal_of(format, bytes) + bytes;
}

std::string unsealed(const std::string& format, const std::string& bytes) {
    if (bytes.compare(0, format.size() + 1, format + "\n") != 0) {
        throw Hdf5Failure("it is no file of the format " + format);
    }
    std::string content = bytes.size() > seal_size ? bytes.substr(seal_size) : "";
    if (bytes.compare(0, seal_size, seal_of(format, content)) != 0) {
        throw Hdf5Failure("its bytes differ from those that were written");
    }
    return content;
}

}  // namespace grainbench::io
