/// What happens in a scene, one stage after the other. SI units.
#pragma once

#include "core/body/laws/local_damping.hpp"
#include "core/describe.hpp"
#include "core/scene/contact.hpp"
#include "core/scene/driven.hpp"
#include "core/scene/output.hpp"
#include "core/scene/stepping.hpp"
#include "core/types.hpp"
#include "core/walls/motion.hpp"

#include <optional>
#include <string>
#include <vector>

namespace grainbench {

struct StageMotion {
    std::string wall;
    WallMotion motion;

    static constexpr auto fields() {
        return std::tuple{
            required(&StageMotion::wall, "wall", "", any_number(), "name of the wall"),
            required(&StageMotion::motion,
                     "motion",
                     "",
                     any_number(),
                     "motion from the start of this stage on")};
    }
};

struct Stage {
    std::string name;
    double duration = 0.0;
    std::vector<StageMotion> motions;
    std::vector<DrivenGroup> driven;
    std::vector<std::string> released;
    std::optional<Vec3> gravity;
    std::optional<Contact> contact;
    std::optional<LocalDamping> local_damping;
    std::optional<Timestep> timestep;
    std::optional<Output> output;
    std::optional<double> average_interval;

    static constexpr auto fields() {
        return std::tuple{
            field(&Stage::name, "name", "", any_number(), "name for logs and histories"),
            required(&Stage::duration, "duration", "s", at_least(0.0), "simulated time"),
            field(&Stage::motions, "motions", "", any_number(), "walls whose motion changes"),
            field(&Stage::driven,
                  "driven",
                  "",
                  any_number(),
                  "groups that move as told from here on, or otherwise than before"),
            field(&Stage::released,
                  "released",
                  "",
                  any_number(),
                  "names of driven groups that are free from here on"),
            field(&Stage::gravity,
                  "gravity",
                  "m/s^2",
                  any_number(),
                  "acceleration from here on: another direction tilts the whole scene"),
            field(&Stage::contact, "contact", "", any_number(), "contact laws from here on"),
            field(&Stage::local_damping,
                  "local_damping",
                  "",
                  any_number(),
                  "local damping from here on; a coefficient of 0 ends it"),
            field(&Stage::timestep, "timestep", "", any_number(), "timestep scheme from here on"),
            field(&Stage::output, "output", "", any_number(), "output intervals from here on"),
            field(&Stage::average_interval,
                  "average_interval",
                  "s",
                  positive(),
                  "averaging interval of the elevation from here on")};
    }
};

}  // namespace grainbench
