/// Exit codes of the program: scripts depend on them (README.md, Commands).
#pragma once

namespace grainbench::cli {

enum ExitCode : int {
    exit_ok = 0,
    exit_internal = 1,      ///< a bug of ours, or no memory left
    exit_bad_input = 2,     ///< wrong usage, or a scene or argument that is wrong
    exit_unstable = 3,      ///< a guard stopped the simulation
    exit_check_failed = 4,  ///< a check or comparison failed
    exit_input_output = 5,  ///< a file cannot be read or written
    exit_interrupted = 130  ///< stopped by a signal, after writing a checkpoint
};

}  // namespace grainbench::cli
