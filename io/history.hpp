/// Histories and paths of a run as plain tables. Run folders collect them, HDF5 and CSV store them,
/// charts draw them.
#pragma once

#include "core/frame.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace grainbench::io {

/// Columns of equal length; the first two are "time" and "cycle".
struct HistoryTable {
    std::vector<HistoryColumn> columns;
    std::vector<std::vector<double>> values;  ///< one vector per column

    std::size_t rows() const { return values.empty() ? 0 : values.front().size(); }

    /// The numbers of one column; Error(bad_input) lists the names if there is none of that name.
    const std::vector<double>& column(std::string_view name) const;

    /// Adds a row; the first row fixes the columns.
    void append(std::span<const HistoryColumn> row_columns, std::span<const double> row);

    /// Forgets the rows from the given one on.
    void truncate(std::size_t rows_to_keep);
};

/// Traced particles in the order in which they were recorded; points[k] was there at time[k].
struct TraceTable {
    std::vector<double> time;  ///< [s]
    std::vector<TracePoint> points;

    void append(double now, std::span<const TracePoint> traced);
    void truncate(std::size_t points_to_keep);
};

struct RealisationHistory {
    std::int64_t seed = 0;
    HistoryTable history;
    TraceTable traces;
};

/// All that history.h5 holds.
struct History {
    std::string program;  ///< name and version
    std::string scene;    ///< JSON text of the effective scene
    std::string scene_hash;
    std::vector<RealisationHistory> realisations;
};

}  // namespace grainbench::io
