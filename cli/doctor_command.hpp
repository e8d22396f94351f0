/// `grainbench doctor`: which program on which machine, whether it can write and draw.
#pragma once

#include "cli/streams.hpp"

#include <filesystem>

namespace grainbench::cli {

struct DoctorArguments {
    std::filesystem::path folder;  ///< to write a test file in; empty = the system's for such files
};

/// Prints what it finds. Exit code 5 if nothing can be drawn; Error(input_output) if the test file
/// cannot be written and read back.
int doctor_command(const DoctorArguments& arguments, const Streams& streams);

}  // namespace grainbench::cli
