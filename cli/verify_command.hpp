/// `grainbench verify`: runs the cases with a known answer and prints what they gave.
#pragma once

#include "cli/streams.hpp"

#include <filesystem>
#include <string>

namespace grainbench::cli {

struct VerifyArguments {
    std::string filter{};  ///< regular expression, found in the name of a case; empty = all
    bool json = false;     ///< print JSON in place of the table
    bool full = false;     ///< the long series of the stability catalogue
    std::filesystem::path folder{};  ///< gets verify.json, .md and .xml; empty = none
};

/// exit_ok, or exit_check_failed if a check fails.
int verify_command(const VerifyArguments& arguments, const Streams& streams);

}  // namespace grainbench::cli
