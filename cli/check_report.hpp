/// Gathers the numbers of `grainbench check` and writes them for people.
#pragma once

#include "core/scene.hpp"

#include "io/check_report.hpp"

#include <string>
#include <vector>

namespace grainbench::cli {

/// Builds the first realisation, then steps it for some tenths of a second and throws it away.
io::CheckReport check_scene(const Scene& scene, double trial_seconds);

/// One line for each wall that is narrow for its particles.
std::vector<std::string> opening_warnings(const Scene& scene);

std::string check_text(const Scene& scene, const io::CheckReport& report);

}  // namespace grainbench::cli
