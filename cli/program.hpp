/// The program as a function: reads the command line, runs one command, turns whatever goes wrong
/// into a message and an exit code.
#pragma once

#include "cli/streams.hpp"

#include <string>
#include <vector>

namespace grainbench::cli {

/// \param arguments without the name of the program
int run_program(std::vector<std::string> arguments, const Streams& streams);

}  // namespace grainbench::cli
