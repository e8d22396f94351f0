/// What callgrind counted, by function: its files read, and two profiles told apart in words.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace grainbench::test {

/// Instructions by function, without those of what it calls. Instances of a template and lambdas
/// count for the function that they belong to.
struct CallgrindProfile {
    std::string trigger;  ///< why it was written: the text handed to CALLGRIND_DUMP_STATS_AT
    std::map<std::string, double> instructions;

    double total() const;
};

CallgrindProfile read_callgrind(const std::filesystem::path& file);

/// The functions whose counts differ most, as lines to read.
std::string describe_changes(const std::map<std::string, double>& before,
                             const std::map<std::string, double>& after);

}  // namespace grainbench::test
