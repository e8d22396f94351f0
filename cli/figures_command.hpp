/// `grainbench figures`: runs what a set of figures needs, each run once, and draws them all.
#pragma once

#include "cli/streams.hpp"

#include <filesystem>

namespace grainbench::cli {

struct FiguresArguments {
    std::filesystem::path set;
    std::filesystem::path folder;  ///< empty = out/<name of the set>, with "-quick" if quick
    bool quick = false;            ///< shortened runs, as the set says
    unsigned jobs = 0;             ///< realisations side by side; 0 = one for each processor
    bool quiet = false;            ///< nothing but errors on err
};

/// Leaves figures/, runs/ (a cache, so that the same call goes on or draws anew), index.html and
/// index.md in the folder. Returns the exit code: that of an unstable run if there was one, which
/// is drawn nevertheless.
int figures_command(const FiguresArguments& arguments, const Streams& streams);

}  // namespace grainbench::cli
