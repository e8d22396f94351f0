/// Groups of particles that move as told. SI units.
#pragma once

#include "core/describe.hpp"
#include "core/walls/motion.hpp"

#include <string>

namespace grainbench {

/// The particles of a group move as one rigid body, whatever acts on them, and act on the others
/// like a wall: frozen with the motion `fixed`. They feel neither each other nor walls.
struct DrivenGroup {
    std::string group;
    WallMotion motion;

    static constexpr auto fields() {
        return std::tuple{
            required(&DrivenGroup::group, "group", "", any_number(), "name of the group"),
            field(&DrivenGroup::motion, "motion", "", any_number(), "motion; fixed if absent")};
    }
};

}  // namespace grainbench
