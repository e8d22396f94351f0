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

/// The line itself, whatever it says.
class ProgressLine {
public:
    ProgressLine(const Streams& streams, bool quiet);

    /// Clears the line that was drawn.
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// Whether it is time to speak again.
    /// \param wall_seconds since the start
    bool is_due(double wall_seconds) const { return !quiet_ && wall_seconds >= next_; }

    void say(double wall_seconds, const std::string& text);

private:
    const Streams& streams_;
    bool quiet_;
    double next_;            ///< [s] of wall time at which to speak again
    std::size_t drawn_ = 0;  ///< characters on the terminal's line
};

/// The line of one ensemble.
class Progress {
public:
    /// \param first fraction of simulated time that was done before [1]
    Progress(const Streams& streams, bool quiet, double first)
        : line_(streams, quiet), first_(first) {}

    void update(const EnsembleProgress& progress) {
        if (line_.is_due(progress.wall_seconds)) {
            line_.say(progress.wall_seconds, progress_text(progress, first_));
        }
    }

private:
    ProgressLine line_;
    double first_;
};

}  // namespace grainbench::cli
