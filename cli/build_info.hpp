/// Which program this is: for manifests, `doctor` and --version.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace grainbench::cli {

struct BuildInfo {
    std::string version;
    std::string git_hash;  ///< with "-dirty" if tracked files differed; "unknown" without git
    std::string compiler;
    std::string flags;
    std::string build_type;
    std::vector<std::pair<std::string, std::string>> libraries;  ///< names and versions
};

BuildInfo build_info();

/// Name of the processor; "unknown" where the system does not tell.
std::string cpu_model();

}  // namespace grainbench::cli
