/// `grainbench compare`: what two results of the same kind have in common.
#pragma once

#include "cli/streams.hpp"

#include <filesystem>
#include <optional>

namespace grainbench::cli {

struct CompareArguments {
    std::filesystem::path first;
    std::filesystem::path second;
    std::filesystem::path difference;  ///< file for a difference picture; empty = none
    /// What passes: largest 1 - SSIM of pictures, growth of a time, relative deviation of a history
    /// (0 = the same bits); absent = the usual one of the kind.
    std::optional<double> threshold;
    bool json = false;
};

/// Exit code 4 if they differ by more than the threshold.
int compare_command(const CompareArguments& arguments, const Streams& streams);

}  // namespace grainbench::cli
