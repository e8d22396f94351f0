/// Two results of `grainbench bench --json`: what became faster or slower by more than noise.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace grainbench::cli {

enum class BenchVerdict {
    same,     ///< the difference is within the noise of the repetitions
    faster,   ///< by more than the noise
    slower,   ///< by more than the noise, within the threshold
    too_slow  ///< by more than the noise and the threshold
};

struct BenchChange {
    std::string name;
    double before = 0.0;  ///< [s] least time per particle-step
    double after = 0.0;   ///< [s]
    double noise = 0.0;   ///< [1] of the ratio, from the repetitions of both
    BenchVerdict verdict = BenchVerdict::same;

    double ratio() const { return after / before; }
};

struct BenchComparison {
    std::vector<BenchChange> changes;   ///< benchmarks of both results, in the order of the first
    std::vector<std::string> only_old;  ///< names
    std::vector<std::string> only_new;  ///< names
    std::vector<std::string> cautions;  ///< what makes the ratios mean less
};

/// Noise of one result is how far its median lies over its least time: others on the machine can
/// only add to a time. That of a ratio is the root of both squares.
/// Error(bad_input) that names the file if it is no such result.
BenchComparison compare_benchmarks(const std::filesystem::path& before,
                                   const std::filesystem::path& after,
                                   double threshold);

bool is_too_slow(const BenchComparison& comparison);

std::string to_text(const BenchComparison& comparison, double threshold);
std::string to_json(const BenchComparison& comparison, double threshold);

}  // namespace grainbench::cli
