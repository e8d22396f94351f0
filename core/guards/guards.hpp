/// What the guards of a run look for and what they do about it: plain data of the scene. They are
/// on unless a scene says otherwise; core/guards/watch.hpp applies them. State that is not finite
/// always stops a run.
#pragma once

#include "core/box.hpp"
#include "core/describe.hpp"

#include <cstdint>
#include <optional>

namespace grainbench {

enum class GuardAction { stop, warn, ignore };

template <>
struct EnumNames<GuardAction> {
    static constexpr std::array<std::pair<GuardAction, std::string_view>, 3> value{
        {{GuardAction::stop, "stop"},
         {GuardAction::warn, "warn"},
         {GuardAction::ignore, "ignore"}}};
};

/// What is done about a particle that left.
enum class LostAction { stop, warn, remove, ignore };

template <>
struct EnumNames<LostAction> {
    static constexpr std::array<std::pair<LostAction, std::string_view>, 4> value{
        {{LostAction::stop, "stop"},
         {LostAction::warn, "warn"},
         {LostAction::remove, "delete"},
         {LostAction::ignore, "ignore"}}};
};

/// Two bodies deep inside each other: the contact is too soft for its load, or began that way.
struct OverlapGuard {
    double bound = 0.5;
    GuardAction action = GuardAction::stop;

    static constexpr auto fields() {
        return std::tuple{field(&OverlapGuard::bound,
                                "bound",
                                "1",
                                positive(),
                                "largest overlap over the smaller radius"),
                          field(&OverlapGuard::action, "action", "", any_number(), "stop or warn")};
    }
};

/// A particle so fast that it may pass another, or a wall, between two looks at it.
struct SpeedGuard {
    double bound = 0.5;
    GuardAction action = GuardAction::stop;

    static constexpr auto fields() {
        return std::tuple{
            field(&SpeedGuard::bound,
                  "bound",
                  "1",
                  positive(),
                  "largest way in one cycle, relative to the bed or a wall, over the smallest "
                  "radius"),
            field(&SpeedGuard::action, "action", "", any_number(), "stop or warn")};
    }
};

/// A step above what the touching contacts can bear: small motions grow from cycle to cycle, or the
/// step is far above the estimate of the automatic step, which stays below the true limit by a
/// factor of up to two.
struct TimestepGuard {
    double bound = 2.0;
    GuardAction action = GuardAction::warn;

    static constexpr auto fields() {
        return std::tuple{
            field(
                &TimestepGuard::bound,
                "bound",
                "1",
                positive(),
                "largest step over the estimated stable one of the contacts that touch; below it, "
                "motions that grow are looked for"),
            field(&TimestepGuard::action, "action", "", any_number(), "stop or warn")};
    }
};

/// Energy that came neither from walls nor from gravity.
struct EnergyGuard {
    double bound = 0.5;
    GuardAction action = GuardAction::stop;

    static constexpr auto fields() {
        return std::tuple{
            field(&EnergyGuard::bound,
                  "bound",
                  "1",
                  positive(),
                  "largest part of the energy in motion, springs and recent work that nothing "
                  "supplied"),
            field(&EnergyGuard::action, "action", "", any_number(), "stop or warn")};
    }
};

/// Contacts found when they already overlapped.
struct LateContactGuard {
    std::int64_t bound = 0;
    GuardAction action = GuardAction::warn;

    static constexpr auto fields() {
        return std::tuple{
            field(&LateContactGuard::bound, "bound", "1", at_least(0), "number that is tolerated"),
            field(&LateContactGuard::action, "action", "", any_number(), "stop or warn")};
    }
};

/// Particles that left the domain, a closed wall that held them, or their side of a plane.
struct LostGuard {
    std::optional<Box> domain;
    LostAction action = LostAction::warn;

    static constexpr auto fields() {
        return std::tuple{field(&LostGuard::domain,
                                "domain",
                                "m",
                                any_number(),
                                "box that centres stay in; absent = closed walls and planes alone"),
                          field(&LostGuard::action,
                                "action",
                                "",
                                any_number(),
                                "stop, warn, or delete them and count them in the history")};
    }
};

struct Guards {
    OverlapGuard overlap;
    SpeedGuard speed;
    TimestepGuard timestep;
    EnergyGuard energy;
    LateContactGuard late_contacts;
    LostGuard lost;

    static constexpr auto fields() {
        return std::tuple{
            field(&Guards::overlap, "overlap", "", any_number(), "how deep contacts may be"),
            field(&Guards::speed, "speed", "", any_number(), "how far a cycle may carry"),
            field(&Guards::timestep, "timestep", "", any_number(), "how long a step may be"),
            field(&Guards::energy, "energy", "", any_number(), "energy from nowhere"),
            field(&Guards::late_contacts,
                  "late_contacts",
                  "",
                  any_number(),
                  "contacts found already overlapping"),
            field(&Guards::lost, "lost", "", any_number(), "particles that left")};
    }
};

}  // namespace grainbench
