#include "cli/progress.hpp"

#include <fmt/format.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>

namespace grainbench::cli {
namespace {

constexpr double redraw_interval = 0.2;  // [s]
constexpr double log_interval = 10.0;    // [s]

}  // namespace

std::string duration_text(double seconds) {
    const auto whole = static_cast<long long>(std::llround(std::min(std::max(seconds, 0.0), 1e9)));
    if (whole >= 3600) {
        return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
    }
    return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

std::string progress_text(const EnsembleProgress& progress, double first) {
    const double done = progress.fraction - first;
    const double wall = std::max(progress.wall_seconds, 1e-9);
    std::string text = fmt::format("{:5.1f} %  t {:.4g} s  {:.1f} M particle-steps/s  dt {:.3g} s",
                                   100.0 * progress.fraction,
                                   progress.time,
                                   1e-6 * progress.particle_steps / wall,
                                   progress.timestep);
    if (done > 0.0) {
        text += "  left " + duration_text((1.0 - progress.fraction) / done * wall);
    }
    return text;
}

ProgressLine::ProgressLine(const Streams& streams, bool quiet)
    : streams_(streams),
      quiet_(quiet),
      next_(streams.err_is_terminal ? redraw_interval : log_interval) {}

ProgressLine::~ProgressLine() {
    if (drawn_ > 0) {
        streams_.err << '\r' << std::string(drawn_, ' ') << '\r' << std::flush;
    }
}

void ProgressLine::say(double wall_seconds, const std::string& text) {
    if (streams_.err_is_terminal) {
        next_ = wall_seconds + redraw_interval;
        const std::size_t before = std::exchange(drawn_, text.size());
        const std::size_t blanks = before > drawn_ ? before - drawn_ : 0;
        streams_.err << '\r' << text << std::string(blanks, ' ') << std::flush;
    } else {
        next_ = wall_seconds + log_interval;
        spdlog::logger log("progress",
                           std::make_shared<spdlog::sinks::ostream_sink_mt>(streams_.err));
        log.set_pattern("[%Y-%m-%d %H:%M:%S] %v");
        log.info(text);
        log.flush();
    }
}

}  // namespace grainbench::cli
