/// Scenes at rest for tests of what is measured: spheres where they are put, no gravity, no output.
#pragma once

#include "core/simulation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace grainbench::test {

inline constexpr double radius = 0.01;
inline constexpr double density = 2500.0;
inline constexpr double stiffness = 1e4;
inline constexpr double mass = 4.0 / 3.0 * pi * radius * radius * radius * density;

/// A scene of two species that differ in name alone, each a group; the first `count_of_a` spheres
/// are of species a.
inline Scene still_scene(const std::vector<Vec3>& positions, std::size_t count_of_a = 1U << 30) {
    Scene scene;
    scene.particles.species = {{"a", radius, density}, {"b", radius, density}};
    ListInsertion list;
    for (std::size_t k = 0; k < positions.size(); ++k) {
        Placement placement;
        placement.species = k < count_of_a ? "a" : "b";
        placement.position = positions[k];
        list.particles.push_back(placement);
    }
    scene.particles.insertion = {list};
    scene.groups = {{.name = "a", .species = "a", .box = {}},
                    {.name = "b", .species = "b", .box = {}}};
    scene.contact.stiffness = ConstantStiffness::Params{.normal = stiffness, .shear = stiffness};
    scene.contact.normal = LinearSpring::Params{};
    scene.timestep = FixedTimestep{1e-5};
    Stage stage;
    stage.duration = 1.0;
    scene.stages = {stage};
    return scene;
}

inline Wall floor_at(const Vec3& point, const Vec3& normal) {
    return {.name = "floor",
            .shape = Plane{.point = point, .normal = normal},
            .motion = FixedMotion{},
            .material = {}};
}

/// What a history would say at the start.
inline double measured(const Scene& scene, const std::string& column) {
    const Simulation simulation(scene, 0);
    const auto& columns = simulation.history_columns();
    const auto found = std::find_if(
        columns.begin(), columns.end(), [&](const auto& c) { return c.name == column; });
    if (found == columns.end()) {
        ADD_FAILURE() << "no column " << column;
        return 0.0;
    }
    EXPECT_EQ(simulation.history_row().size(), columns.size());
    return simulation.history_row().at(static_cast<std::size_t>(found - columns.begin()));
}

}  // namespace grainbench::test
