#include "core/measure/memory_need.hpp"

#include "core/error.hpp"
#include "core/simulation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace grainbench {
namespace {

using testing::HasSubstr;

Scene lattice(std::vector<std::int64_t> counts) {
    Scene scene;
    scene.particles.species = {{"ball", 0.001, 2000.0}};
    scene.particles.insertion = {LatticeInsertion{.species = "ball",
                                                  .origin = {},
                                                  .spacing = {0.002, 0.002, 0.002},
                                                  .counts = std::move(counts),
                                                  .velocity = {},
                                                  .jitter = 0.0}};
    Stage stage;
    stage.duration = 1.0;
    scene.stages = {stage};
    return scene;
}

void expect_refused(const Scene& scene, const std::string& where) {
    try {
        const Simulation simulation(scene, 0);
        FAIL() << "not refused";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::bad_input);
        EXPECT_EQ(error.diagnosis().where, where);
        EXPECT_THAT(error.diagnosis().what, HasSubstr(" bytes of memory"));
    }
}

TEST(MemoryNeed, IsRefusedBeyondThatOfTheMachine) {
    expect_refused(lattice({100000, 100000, 100000}), "/particles/insertion/0");
    Scene fine = lattice({1, 1, 1});
    fine.walls = {{.name = "drum",
                   .shape = FacetedCylinder{.radius = 1.0, .height = 1.0, .resolution = 1e-12},
                   .motion = FixedMotion{},
                   .material = {}}};
    expect_refused(fine, "/walls/0/shape");
    Scene many = lattice({3000, 1000, 100});
    many.realisations.count = 10000;
    expect_refused(many, "/particles/insertion/0");
}

TEST(MemoryNeed, OfRandomInsertionIsBoundedByItsBox) {
    Scene scene = lattice({});
    scene.particles.insertion = {RandomInsertion{.species = "ball",
                                                 .count = std::int64_t{1} << 60,
                                                 .tries = std::int64_t{1} << 60,
                                                 .box = {{0.0, 0.0, 0.0}, {0.1, 0.1, 0.1}},
                                                 .inside = {}}};
    EXPECT_GT(estimate_memory(scene).bytes, 1e8);
    EXPECT_LT(estimate_memory(scene).bytes, 1e9);
}

}  // namespace
}  // namespace grainbench
