#include "render/trace_view.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <variant>

namespace grainbench::render {
namespace {

/// Points of one path from `first` to `last`, without the last one.
struct Stretch {
    std::size_t first = 0;
    std::size_t last = 0;
};

std::vector<Stretch> paths_of(const io::TraceTable& all, double until) {
    std::vector<Stretch> paths;
    for (std::size_t k = 0; k < all.points.size(); ++k) {
        if (k == 0 || all.points[k - 1].id != all.points[k].id) {
            paths.push_back({.first = k, .last = k});
        }
        if (all.time[k] <= until * (1.0 + 1e-9)) {
            paths.back().last = k + 1;
        }
    }
    return paths;
}

TracePoint mean_of(const std::vector<TracePoint>& points, Stretch window) {
    TracePoint mean;
    const double share = 1.0 / static_cast<double>(window.last - window.first);
    for (std::size_t k = window.first; k < window.last; ++k) {
        mean.id = points[k].id;
        mean.position += share * points[k].position;
        mean.velocity += share * points[k].velocity;
    }
    return mean;
}

std::string title_of(const TraceLook& look) {
    if (std::holds_alternative<TimeColour>(look.colour)) {
        return "time [s]";
    }
    return look.interval > 0.0 ? "drift [m/s]" : "speed of trace [m/s]";
}

}  // namespace

io::TraceTable mean_path(const io::TraceTable& all, double until, double interval) {
    constexpr double points_in_an_interval = 5.0;  // enough to look round
    io::TraceTable path;
    for (const Stretch& stretch : paths_of(all, until)) {
        // A sample comes with the first step at or after its time: some steps late at most.
        const double late = 1e-3 * interval;
        double next = all.time[stretch.first];
        Stretch window{.first = stretch.first, .last = stretch.first};
        for (std::size_t k = stretch.first; k < stretch.last; ++k) {
            const double now = all.time[k];
            if (now < next - late && k + 1 < stretch.last) {
                continue;
            }
            next += interval / points_in_an_interval;
            while (window.first < k && all.time[window.first] <= now - 0.5 * interval + late) {
                ++window.first;
            }
            while (window.last < stretch.last &&
                   all.time[window.last] <= now + 0.5 * interval + late) {
                ++window.last;
            }
            path.time.push_back(now);
            path.points.push_back(mean_of(all.points, window));
        }
    }
    return path;
}

TraceView view_traces(const std::vector<io::TraceTable>& all, const TraceLook& look, double time) {
    TraceView view;
    std::vector<std::vector<double>> values;
    std::vector<double> together;
    const bool by_time = std::holds_alternative<TimeColour>(look.colour);
    for (const io::TraceTable& path : all) {
        view.paths.push_back(mean_path(path, time, look.interval));
        std::vector<double>& of_path = values.emplace_back();
        for (std::size_t k = 0; k < view.paths.back().points.size(); ++k) {
            of_path.push_back(by_time ? view.paths.back().time[k]
                                      : norm(view.paths.back().points[k].velocity));
        }
        together.insert(together.end(), of_path.begin(), of_path.end());
    }
    std::visit([&](const auto& colour) { view.scale.map = colour.map; }, look.colour);
    const std::optional<Range> asked =
        std::visit([](const auto& colour) { return colour.range; }, look.colour);
    view.scale.title = title_of(look);
    view.scale.range = range_of(
        by_time && !asked && time > 0.0 ? std::optional(Range{0.0, time}) : asked, together);
    for (const std::vector<double>& of_path : values) {
        std::vector<Colour>& colours = view.colours.emplace_back();
        for (const double value : of_path) {
            colours.push_back(map_colour(view.scale.map, fraction_in(view.scale.range, value)));
        }
    }
    return view;
}

}  // namespace grainbench::render
