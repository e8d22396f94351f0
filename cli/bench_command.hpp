/// `grainbench bench`: what a particle-step costs on this machine.
#pragma once

#include <filesystem>
#include <ostream>
#include <string>

namespace grainbench::cli {

/// What a measurement means nothing without; the instruction set is added by the benchmarks.
struct BenchMachine {
    std::string cpu_model;
    std::string compiler;
    std::string flags;
    std::string program;  ///< version and commit
};

struct BenchArguments {
    std::string filter;            ///< regular expression on names; empty = all
    bool json = false;             ///< JSON on out instead of the table
    std::filesystem::path output;  ///< file for the JSON as well; empty = none
    unsigned threads = 1;          ///< copies stepped side by side, one per thread
    unsigned scaling = 0;          ///< threads that share each scene, against one; 0 = not asked
};

/// Returns the exit code; errors of the input and of files are thrown.
/// \param out the report  \param err which benchmark runs now
int bench_command(const BenchArguments& arguments,
                  const BenchMachine& machine,
                  std::ostream& out,
                  std::ostream& err);

}  // namespace grainbench::cli
