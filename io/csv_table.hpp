/// A CSV file as text cells with the line each row stands on, for messages that name file and line.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace grainbench::io {

struct CsvRow {
    std::size_t line = 0;  ///< from 1
    std::vector<std::string> cells;
};

struct CsvTable {
    std::filesystem::path path;
    CsvRow header;
    std::vector<CsvRow> rows;

    /// "file.csv:12"
    std::string place(const CsvRow& row) const;

    /// The cell as a finite number; Error(bad_input) with line and column name otherwise.
    double number(const CsvRow& row, std::size_t column) const;
};

/// Cells are separated by commas and may stand in double quotes; empty lines do not count.
/// Error(bad_input) if there is no header, or a row has another number of cells than the header.
CsvTable read_csv(const std::filesystem::path& path);

}  // namespace grainbench::io
