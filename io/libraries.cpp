#include "io/libraries.hpp"

#include "core/error.hpp"

#include <hdf5.h>
#include <vtkVersion.h>

namespace grainbench::io {

std::vector<std::pair<std::string, std::string>> loaded_libraries() {
    unsigned major = 0;
    unsigned minor = 0;
    unsigned release = 0;
    if (H5get_libversion(&major, &minor, &release) < 0) {
        throw_input_output({.what = "the HDF5 library does not tell its version",
                            .where = "libhdf5",
                            .likely_cause = "a damaged installation",
                            .next_step = "install libhdf5-dev again"});
    }
    return {{"VTK", vtkVersion::GetVTKVersion()},
            {"HDF5",
             std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(release)}};
}

}  // namespace grainbench::io
