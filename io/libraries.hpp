/// Versions of the shared libraries that this process has loaded, which may differ from those it
/// was built with.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace grainbench::io {

/// Names and versions.
std::vector<std::pair<std::string, std::string>> loaded_libraries();

}  // namespace grainbench::io
