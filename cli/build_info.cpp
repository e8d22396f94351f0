#include "cli/build_info.hpp"

#include "core/version.hpp"

#include "cli/build_settings.hpp"
#include "cli/git_hash.hpp"

#include <fstream>

namespace grainbench::cli {

BuildInfo build_info() {
    return {.version = version,
            .git_hash = git_hash,
            .compiler = build_compiler,
            .flags = build_flags,
            .build_type = build_type,
            .libraries = {{"Eigen", eigen_version},
                          {"Highway", highway_version},
                          {"nlohmann-json", json_version}}};
}

std::string cpu_model() {
    std::ifstream cpuinfo("/proc/cpuinfo");
    for (std::string line; std::getline(cpuinfo, line);) {
        const std::size_t colon = line.find(": ");
        if (line.starts_with("model name") && colon != std::string::npos) {
            return line.substr(colon + 2);
        }
    }
    return "unknown";
}

}  // namespace grainbench::cli
