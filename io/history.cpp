#include "io/history.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <stdexcept>

namespace grainbench::io {

const std::vector<double>& HistoryTable::column(std::string_view name) const {
    std::string known;
    for (std::size_t k = 0; k < columns.size(); ++k) {
        if (columns[k].name == name) {
            return values[k];
        }
        known += (known.empty() ? "" : ", ") + columns[k].name;
    }
    throw_bad_input({.what = "the history has no column '" + std::string(name) + "'",
                     .where = "history",
                     .likely_cause = "the scene does not ask for this observable",
                     .next_step = "choose one of: " + (known.empty() ? "(no columns)" : known)});
}

void HistoryTable::append(std::span<const HistoryColumn> row_columns, std::span<const double> row) {
    if (columns.empty()) {
        columns.assign(row_columns.begin(), row_columns.end());
        values.resize(columns.size());
    }
    if (row.size() != columns.size() || row_columns.size() != columns.size()) {
        throw std::logic_error("a history row does not fit its columns");
    }
    for (std::size_t k = 0; k < row.size(); ++k) {
        values[k].push_back(row[k]);
    }
}

void HistoryTable::truncate(std::size_t rows_to_keep) {
    for (std::vector<double>& column : values) {
        column.resize(std::min(column.size(), rows_to_keep));
    }
}

void TraceTable::append(double now, std::span<const TracePoint> traced) {
    time.insert(time.end(), traced.size(), now);
    points.insert(points.end(), traced.begin(), traced.end());
}

void TraceTable::truncate(std::size_t points_to_keep) {
    time.resize(std::min(time.size(), points_to_keep));
    points.resize(time.size());
}

}  // namespace grainbench::io
