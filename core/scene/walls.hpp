/// The rigid bodies of a scene. SI units.
#pragma once

#include "core/describe.hpp"
#include "core/walls/motion.hpp"
#include "core/walls/shapes.hpp"

#include <optional>
#include <string>

namespace grainbench {

/// A rigid body of infinite mass: one shape, one motion.
struct Wall {
    std::string name;
    WallShape shape;
    WallMotion motion;
    std::optional<std::string> material;

    static constexpr auto fields() {
        return std::tuple{
            required(&Wall::name, "name", "", any_number(), "name, unique among walls"),
            required(&Wall::shape, "shape", "", any_number(), "geometry"),
            field(&Wall::motion, "motion", "", any_number(), "motion from the first stage on"),
            field(&Wall::material,
                  "material",
                  "",
                  any_number(),
                  "name used in contact.pairs; the wall's name if absent")};
    }

    const std::string& material_name() const { return material ? *material : name; }
};

}  // namespace grainbench
