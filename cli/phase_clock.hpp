/// A clock for the parts of a cycle.
#pragma once

#include "core/phases.hpp"

#include <array>
#include <chrono>
#include <string_view>

namespace grainbench::cli {

/// Seconds by Phase.
using PhaseTimes = std::array<double, phase_count>;

inline constexpr std::array<std::string_view, phase_count> phase_names{
    "timestep", "integration", "detection", "contacts", "walls", "output"};

/// Sums the time between the parts that it is told of.
class PhaseClock : public PhaseWatch {
public:
    void enter(Phase phase) override {
        const auto now = Clock::now();
        if (is_running_) {
            seconds_[static_cast<std::size_t>(phase_)] +=
                std::chrono::duration<double>(now - start_).count();
        }
        start_ = now;
        phase_ = phase;
        is_running_ = true;
    }

    /// Ends the phase that runs.
    void stop() {
        enter(phase_);
        is_running_ = false;
    }

    const PhaseTimes& seconds() const { return seconds_; }

private:
    using Clock = std::chrono::steady_clock;

    PhaseTimes seconds_{};
    Clock::time_point start_;
    Phase phase_ = Phase::timestep;
    bool is_running_ = false;
};

}  // namespace grainbench::cli
