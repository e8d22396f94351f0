/// Two run folders: how far their histories are apart, and whether their particles are the same.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace grainbench::cli {

/// One history column that is not the same bits in both runs.
struct ColumnDeviation {
    std::size_t realisation = 1;
    std::string name;
    std::string unit;
    double largest = 0.0;   ///< [unit] |a - b|
    double relative = 0.0;  ///< [1] over the largest magnitude of the column in either run
    double time = 0.0;      ///< [s] where it is largest
};

struct DifferingRow {
    std::size_t realisation = 1;
    std::size_t row = 0;
    std::uint64_t cycle = 0;
    double time = 0.0;  ///< [s]
};

struct RunComparison {
    std::vector<std::string> structure;  ///< columns, rows, files, realisations of one run alone
    std::size_t columns = 0;             ///< compared, over all realisations
    std::vector<ColumnDeviation> deviations;
    std::optional<DifferingRow> first_row;  ///< by time
    std::size_t particle_files = 0;         ///< compared
    std::size_t differing_files = 0;
    std::string first_differing_file;
    bool same_last_state = true;  ///< hash of every bit that steers the next step

    double largest_relative() const;
    bool is_same() const;

    /// Within `threshold`; 0 asks for the same bits everywhere.
    bool is_within(double threshold) const;
};

RunComparison compare_runs(const std::filesystem::path& first, const std::filesystem::path& second);

std::string to_text(const RunComparison& comparison, double threshold);
std::string to_json(const RunComparison& comparison, double threshold);

}  // namespace grainbench::cli
