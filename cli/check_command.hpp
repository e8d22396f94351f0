/// `grainbench check`: what a scene asks for, what it will cost, and what looks wrong. Writes
/// nothing.
#pragma once

#include "cli/streams.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace grainbench::cli {

struct CheckArguments {
    std::filesystem::path scene;
    std::vector<std::string> overrides;  ///< "/json/pointer=value"
    bool json = false;
    double trial_seconds = 0.3;  ///< [s] of wall time to step for the estimate of the speed
};

/// Returns the exit code; errors of the input are thrown.
int check_command(const CheckArguments& arguments, const Streams& streams);

}  // namespace grainbench::cli
