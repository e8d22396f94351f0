/// When a run writes its files. SI units.
#pragma once

#include "core/describe.hpp"

#include <cstdint>
#include <optional>

namespace grainbench {

/// When files are written. An absent interval means never (but the end of the run is always
/// written).
struct Output {
    std::optional<double> frame_interval;
    std::optional<double> history_interval;
    std::optional<std::int64_t> history_cycles;
    std::optional<double> trace_interval;
    std::optional<double> field_interval;
    std::optional<double> checkpoint_interval;
    bool contacts = false;
    bool orientation = false;

    static constexpr auto fields() {
        return std::tuple{
            field(&Output::frame_interval,
                  "frame_interval",
                  "s",
                  positive(),
                  "time between frames (particles, walls)"),
            field(&Output::history_interval,
                  "history_interval",
                  "s",
                  positive(),
                  "time between rows of the history"),
            field(&Output::history_cycles,
                  "history_cycles",
                  "1",
                  at_least(1),
                  "cycles between rows of the history; instead of history_interval"),
            field(&Output::trace_interval,
                  "trace_interval",
                  "s",
                  positive(),
                  "time between points of a trace"),
            field(&Output::field_interval,
                  "field_interval",
                  "s",
                  positive(),
                  "time between fields of observables.coarse_graining; absent = with "
                  "each frame"),
            field(&Output::checkpoint_interval,
                  "checkpoint_interval",
                  "s",
                  positive(),
                  "simulated time between checkpoints"),
            field(&Output::contacts,
                  "contacts",
                  "",
                  any_number(),
                  "write the contact network with each frame"),
            field(&Output::orientation,
                  "orientation",
                  "",
                  any_number(),
                  "write how particles have turned with each frame of the run; in any "
                  "stage it holds for all")};
    }
};

}  // namespace grainbench
