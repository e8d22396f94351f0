// The stable step of scenes of many slabs, whose sums are taken slab by slab.
#include "core/engine.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace grainbench::test {
namespace {

constexpr double radius = 0.01;
constexpr double density = 1000.0;
constexpr double light = 1.0;  // kg/m^3
constexpr double stiffness = 1e4;

/// Spheres in a row, one of which is light: it alone decides on the step. They touch but for the
/// first, `alone` of which have gaps behind them, so that slabs end anywhere in the list of pairs.
Scene chain(int length, int alone, int place_of_light) {
    ListInsertion row;
    double x = 0.0;
    for (int n = 0; n < length; ++n) {
        row.particles.push_back(
            {.species = n == place_of_light ? "light" : "heavy", .position = {x, 0.0, 0.0}});
        x += (n < alone ? 3.0 : 1.999) * radius;
    }
    Scene scene;
    scene.particles.species = {{.name = "heavy", .radius = radius, .density = density},
                               {.name = "light", .radius = radius, .density = light}};
    scene.particles.insertion.emplace_back(std::move(row));
    scene.contact.stiffness = ConstantStiffness::Params{.normal = stiffness, .shear = stiffness};
    AutomaticTimestep timestep;
    timestep.safety_factor = 1.0;
    scene.timestep = timestep;
    Stage stage;
    stage.duration = 1.0;
    scene.stages.push_back(stage);
    return scene;
}

/// Rolling about an axis across the row rules: sqrt(I / (contacts k_s R^2)), I = 2/5 m R^2 [s].
double limit_of_light(int contacts) {
    const double mass = 4.0 / 3.0 * pi * radius * radius * radius * light;
    return std::sqrt(0.4 * mass / (contacts * stiffness));
}

/// Numbers of spheres of which nine slabs are made. Lists of contacts are read in blocks of up to
/// eight and laid out in words of 64: all that may be left over at their ends.
constexpr int shortest = 9 * 1024;

TEST(StableStep, CountsEachContactOnceWhereverSlabsEnd) {
    for (int more = 0; more < 64; ++more) {
        const int length = shortest + more;
        for (const int place : {8, 1023, 1024, 1025, 5119, 5120, length - 2, length - 1}) {
            const Scene scene = chain(length, more % 8, place);
            Engine engine(scene, 1, {});
            ASSERT_GT(engine.particles().slab_count(), 8U);
            engine.begin_stage(scene.stages[0]);
            const int contacts = (place > more % 8 ? 1 : 0) + (place < length - 1 ? 1 : 0);
            const double expected = limit_of_light(contacts);
            // Rounding of positions of up to 200 m, in the directions of contacts of 0.02 m.
            EXPECT_NEAR(engine.next_timestep() / expected, 1.0, 1e-9) << length << ' ' << place;
            EXPECT_NEAR(engine.compute_touching_limit() / expected, 1.0, 1e-9)
                << length << ' ' << place;
        }
    }
}

}  // namespace
}  // namespace grainbench::test
