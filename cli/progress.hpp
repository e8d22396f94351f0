/// How far a run is: one line drawn over itself on a terminal, a log line now and then elsewhere.
#pragma once

#include "core/ensemble.hpp"

#include "cli/streams.hpp"

#include <string>

namespace grainbench::cli {

/// "1:02:03", "4:05"; "0:00" for less than half a second.
std::string duration_text(double seconds);

/// \param first fraction that was done before this call [1]
std::string progress_text(const EnsembleProgress& progress, double first);

class Progress {
public:
    /// \param first fraction of simulated time that was done before [1]
    Progress(const Streams& streams, bool quiet, double first);

    /// Clears the line that was drawn.
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void update(const EnsembleProgress& progress);

private:
    const Streams& streams_;
    bool quiet_;
    double first_;
    double next_;            ///< [s] of wall time at which to speak again
    std::size_t drawn_ = 0;  ///< characters on the terminal's line
};

}  // namespace grainbench::cli
