/// Calls the program as a function and keeps what it said.
#pragma once

#include "cli/program.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace grainbench::cli {

struct Answer {
    int code = 0;
    std::string out;
    std::string err;
};

inline Answer invoke(std::vector<std::string> arguments) {
    std::ostringstream out;
    std::ostringstream err;
    const int code = run_program(std::move(arguments), {.out = out, .err = err});
    return {code, out.str(), err.str()};
}

inline std::string preset(const std::string& name) {
    return std::string(GRAINBENCH_SOURCE_DIR) + "/presets/scenes/" + name;
}

}  // namespace grainbench::cli
