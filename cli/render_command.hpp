/// `grainbench render`: pictures of the particles of a run.
#pragma once

#include "cli/streams.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace grainbench::cli {

struct RenderArguments {
    std::filesystem::path source;        ///< run folder, or a look that names one
    std::filesystem::path folder;        ///< for the pictures; empty = `pictures` in the run folder
    std::filesystem::path look;          ///< empty = the default look
    std::vector<std::string> times;      ///< numbers, "first" or "last"; empty = as the look says
    std::string size;                    ///< "1600x1000"; empty = as the look says
    std::vector<std::string> overrides;  ///< "/json/pointer=value" for the look
    bool quiet = false;
};

/// Prints the path of each picture when it is written.
int render_command(const RenderArguments& arguments, const Streams& streams);

}  // namespace grainbench::cli
