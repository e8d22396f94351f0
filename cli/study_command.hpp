/// `grainbench study`: settings of a scene compared, accuracy against time.
#pragma once

#include "cli/streams.hpp"

#include <filesystem>

namespace grainbench::cli {

struct StudyArguments {
    std::filesystem::path study;    ///< study file; empty with `suggest`
    std::filesystem::path suggest;  ///< scene to make a small study for; empty = none
    std::filesystem::path folder;   ///< empty = out/<name of the file>, "-quick" after it
    std::filesystem::path cache;    ///< of runs; empty = <folder>/runs
    unsigned threads = 0;           ///< 0 = one for each processor
    bool single_contact = false;    ///< one impact in place of a study file
    bool stability_map = false;     ///< the map in place of a study file
    bool quick = false;
    bool quiet = false;  ///< no talk
    bool json = false;   ///< JSON on out in place of the table
};

/// Returns the exit code; errors of the input and of files are thrown.
int study_command(const StudyArguments& arguments, const Streams& streams);

}  // namespace grainbench::cli
