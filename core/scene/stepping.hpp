/// How a scene chooses its timestep and finds its contacts. SI units.
#pragma once

#include "core/describe.hpp"

#include <cstdint>
#include <optional>
#include <variant>

namespace grainbench {

/// dt = min(safety_factor * stable step, kinematic limit, maximum), grown by at most `growth` a
/// cycle.
struct AutomaticTimestep {
    static constexpr std::string_view key = "automatic";
    double safety_factor = 0.8;
    double growth = 1.05;
    std::optional<double> maximum;

    static constexpr auto fields() {
        return std::tuple{
            field(&AutomaticTimestep::safety_factor,
                  "safety_factor",
                  "1",
                  positive(),
                  "fraction of the estimated stable step"),
            field(&AutomaticTimestep::growth,
                  "growth",
                  "1",
                  Domain{.low = 1.0, .low_open = true},
                  "largest growth factor from one cycle to the next"),
            field(&AutomaticTimestep::maximum, "maximum", "s", positive(), "upper bound")};
    }
};

struct FixedTimestep {
    static constexpr std::string_view key = "fixed";
    double value = 0.0;

    static constexpr auto fields() {
        return std::tuple{required(&FixedTimestep::value, "value", "s", positive(), "the step")};
    }
};

/// Inertial masses are scaled so that the stable step of every particle is `value`; gravity uses
/// the real mass. Time has no meaning: for quasi-static states only.
struct ScaledTimestep {
    static constexpr std::string_view key = "scaled";
    double value = 1.0;
    double safety_factor = 0.8;

    static constexpr auto fields() {
        return std::tuple{field(&ScaledTimestep::value, "value", "s", positive(), "the step"),
                          field(&ScaledTimestep::safety_factor,
                                "safety_factor",
                                "1",
                                positive(),
                                "fraction of the estimated stable step")};
    }
};

using Timestep = std::variant<AutomaticTimestep, FixedTimestep, ScaledTimestep>;

/// Contacts are looked for when a particle has moved by its tolerance relative to the bed.
struct DisplacementTrigger {
    static constexpr std::string_view key = "displacement";

    static constexpr auto fields() { return std::tuple{}; }
};

/// Contacts are looked for every `interval` cycles, whatever moved: cheaper, may find contacts
/// late.
struct RemapInterval {
    static constexpr std::string_view key = "interval";
    std::int64_t cycles = 10;

    static constexpr auto fields() {
        return std::tuple{required(
            &RemapInterval::cycles, "cycles", "1", at_least(1), "cycles between two searches")};
    }
};

using DetectionTrigger = std::variant<DisplacementTrigger, RemapInterval>;

struct Detection {
    DetectionTrigger trigger;
    double tolerance = 0.0625;
    bool create_on_overlap = false;

    static constexpr auto fields() {
        return std::tuple{
            field(&Detection::trigger, "trigger", "", any_number(), "when contacts are looked for"),
            field(
                &Detection::tolerance,
                "tolerance",
                "1",
                positive(),
                "detection tolerance of a particle over its radius: contacts exist within the sum"),
            field(&Detection::create_on_overlap,
                  "create_on_overlap",
                  "",
                  any_number(),
                  "contacts exist only while surfaces overlap")};
    }
};

}  // namespace grainbench
