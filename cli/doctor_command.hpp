/// `grainbench doctor`: which program on which machine, and whether it can write.
#pragma once

#include "cli/streams.hpp"

#include <filesystem>

namespace grainbench::cli {

struct DoctorArguments {
    std::filesystem::path folder;  ///< to write a test file in; empty = the system's for such files
};

/// Error(input_output) if the test file cannot be written and read back.
int doctor_command(const DoctorArguments& arguments, const Streams& streams);

}  // namespace grainbench::cli
