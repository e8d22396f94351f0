/// A sum over the bytes of an HDF5 file, in front of them. HDF5 trusts what it reads and may crash
/// on a damaged file, so damage has to be found before HDF5 sees it. Other programs skip the seal.
#pragma once

#include <string>

namespace grainbench::io {

/// The file with its seal.
/// \param format name and version of the format, such as "grainbench-checkpoint/1"
std::string sealed(const std::string& format, const std::string& bytes);

/// The file without its seal; throws Hdf5Failure if the seal is missing, of another format, or does
/// not fit the bytes.
std::string unsealed(const std::string& format, const std::string& bytes);

}  // namespace grainbench::io
