/// Paths of traced particles as tubes show them: smoothed by means over a time, and coloured.
/// Internal to render.
#pragma once

#include "io/history.hpp"

#include "render/colour_map.hpp"
#include "render/look.hpp"
#include "render/particle_view.hpp"

#include <vector>

namespace grainbench::render {

/// One table of points and their colours for each realisation, and what the colours mean.
struct TraceView {
    std::vector<io::TraceTable> paths;
    std::vector<std::vector<Colour>> colours;
    ColourScale scale;
};

/// Paths from the start to `time`.
TraceView view_traces(const std::vector<io::TraceTable>& all, const TraceLook& look, double time);

/// Sliding means of position and velocity over times of length `interval`, a fifth of it apart, up
/// to a time; shorter ones at both ends. All of the points where the interval is 0. \param all the
/// points of one path stand together, in order of time
io::TraceTable mean_path(const io::TraceTable& all, double until, double interval);

}  // namespace grainbench::render
