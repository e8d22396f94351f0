#include "io/csv_table.hpp"

#include "core/error.hpp"

#include "io/atomic_file.hpp"

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace grainbench::io {
namespace {

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blanks = " \t\r";
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) {
        return {};
    }
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// A cell without its quotes; nothing if they do not match.
std::optional<std::string> unquoted(std::string_view text) {
    const std::string_view cell = trimmed(text);
    if (cell.empty() || cell.front() != '"') {
        return std::string(cell);
    }
    std::string result;
    for (std::size_t k = 1; k < cell.size(); ++k) {
        if (cell[k] != '"') {
            result += cell[k];
        } else if (k + 1 < cell.size() && cell[k + 1] == '"') {
            result += '"';
            ++k;
        } else {
            return k + 1 == cell.size() ? std::optional(result) : std::nullopt;
        }
    }
    return std::nullopt;
}

/// Cells of a line; nothing if its quotes do not match.
std::optional<std::vector<std::string>> split(std::string_view line) {
    std::vector<std::string> cells;
    bool is_quoted = false;
    std::size_t start = 0;
    for (std::size_t k = 0; k <= line.size(); ++k) {
        if (k < line.size() && line[k] == '"') {
            is_quoted = !is_quoted;
        }
        if (k == line.size() || (line[k] == ',' && !is_quoted)) {
            std::optional<std::string> cell = unquoted(line.substr(start, k - start));
            if (!cell) {
                return std::nullopt;
            }
            cells.push_back(std::move(*cell));
            start = k + 1;
        }
    }
    return cells;
}

std::string place_of(const std::filesystem::path& path, std::size_t line) {
    return path.string() + ":" + std::to_string(line);
}

}  // namespace

std::string CsvTable::place(const CsvRow& row) const {
    return place_of(path, row.line);
}

double CsvTable::number(const CsvRow& row, std::size_t column) const {
    const std::string& cell = row.cells[column];
    std::string_view digits = cell;
    if (digits.starts_with('+')) {  // from_chars knows no plus sign
        digits.remove_prefix(1);
    }
    double value = 0.0;
    const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (code != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value)) {
        throw_bad_input({.what = "'" + cell + "' in column '" + header.cells[column] +
                                 "' is not a finite number",
                         .where = place(row),
                         .likely_cause = "a typing error, or a decimal comma",
                         .next_step = "write a number such as 0.0015 or 1.5e-3"});
    }
    return value;
}

CsvTable read_csv(const std::filesystem::path& path) {
    const std::string bytes = read_file(path);
    std::string_view rest = bytes;
    if (rest.starts_with("\xEF\xBB\xBF")) {  // spreadsheets mark UTF-8 like this
        rest.remove_prefix(3);
    }
    CsvTable table{.path = path, .header = {}, .rows = {}};
    for (std::size_t line = 1; !rest.empty(); ++line) {
        const std::size_t end = rest.find('\n');
        const std::string_view text = rest.substr(0, end);
        rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
        if (trimmed(text).empty()) {
            continue;
        }
        std::optional<std::vector<std::string>> cells = split(text);
        if (!cells) {
            throw_bad_input({.what = "the quotes of a line do not match",
                             .where = place_of(path, line),
                             .likely_cause = "a quote within a cell that is not doubled",
                             .next_step = "write \"\" for a quote within quotes"});
        }
        if (table.header.cells.empty()) {
            table.header = {.line = line, .cells = std::move(*cells)};
        } else if (cells->size() != table.header.cells.size()) {
            throw_bad_input({.what = "a row has " + std::to_string(cells->size()) +
                                     " cells, the header has " +
                                     std::to_string(table.header.cells.size()),
                             .where = place_of(path, line),
                             .likely_cause = "the file is cut off, or a comma is missing",
                             .next_step = "give each row one cell for each name of the header"});
        } else {
            table.rows.push_back({.line = line, .cells = std::move(*cells)});
        }
    }
    if (table.header.cells.empty()) {
        throw_bad_input({.what = "the file is empty",
                         .where = path.string(),
                         .likely_cause = "the wrong file",
                         .next_step = "begin with a line of column names, such as x,y,z,radius"});
    }
    return table;
}

}  // namespace grainbench::io
