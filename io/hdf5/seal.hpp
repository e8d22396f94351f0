/// A sum over the bytes of an HDF5 file, in front of them. HDF5 trusts what it reads and may crash
/// on a damaged file, so damage has to be found before HDF5 sees it. Other programs skip the seal.
#pragma once

#include <string>
#include <string_view>

namespace grainbench::io {

/// What goes in front of the bytes of a file.
/// \param format name and version of the format, such as "grainbench-checkpoint/1"
std::string seal_of(const std::string& format, std::string_view bytes);

/// The file without its seal; throws Hdf5Failure if the seal is missing, of another format, or does
/// not fit the bytes.
std::string unsealed(const std::string& format, std::string bytes);

}  // namespace grainbench::io
