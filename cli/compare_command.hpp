/// `grainbench compare`: what two results of the same kind have in common.
#pragma once

#include "cli/streams.hpp"

#include <filesystem>

namespace grainbench::cli {

struct CompareArguments {
    std::filesystem::path first;
    std::filesystem::path second;
    std::filesystem::path difference;  ///< file for a difference picture; empty = none
    double threshold = 0.02;           ///< largest 1 - SSIM that passes
    bool json = false;
};

/// Exit code 4 if they differ by more than the threshold.
int compare_command(const CompareArguments& arguments, const Streams& streams);

}  // namespace grainbench::cli
