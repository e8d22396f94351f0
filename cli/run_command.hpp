/// `grainbench run`: a scene into a run folder.
#pragma once

#include "cli/streams.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace grainbench::cli {

struct RunArguments {
    std::filesystem::path scene;
    std::filesystem::path folder;        ///< empty = out/<name of the scene>
    std::vector<std::string> overrides;  ///< "/json/pointer=value"
    unsigned threads = 0;                ///< 0 = one for each processor
    bool resume = false;
    bool quiet = false;          ///< nothing but errors on err
    bool json = false;           ///< the manifest on out
    bool history_csv = false;    ///< history.csv beside history.h5
    std::filesystem::path look;  ///< draws every frame in the end as `render --look` does
};

/// Returns the exit code; errors of the input and of files are thrown.
int run_command(const RunArguments& arguments, const Streams& streams);

}  // namespace grainbench::cli
