#include "core/simulation.hpp"

#include "io/atomic_file.hpp"
#include "io/run_folder.hpp"

#include "tests/unit/io/temporary_folder.hpp"

#include <gtest/gtest.h>

namespace grainbench::io {
namespace {

/// Eight spheres that fall on a plane within the 0.02 s of the run.
Scene falling_spheres() {
    Scene scene;
    scene.gravity = Vec3{0, 0, -9.81};
    scene.particles.species.push_back({.name = "glass", .radius = 1e-3, .density = 2500.0});
    LatticeInsertion lattice;
    lattice.species = "glass";
    lattice.origin = {0, 0, 1.2e-3};
    lattice.spacing = {2.5e-3, 2.5e-3, 2.5e-3};
    lattice.counts = {2, 2, 2};
    scene.particles.insertion.emplace_back(lattice);
    Wall floor;
    floor.name = "floor";
    floor.shape = Plane{};
    scene.walls.push_back(floor);
    scene.contact.stiffness = ConstantStiffness::Params{.normal = 1e4, .shear = 1e4};
    scene.timestep = FixedTimestep{.value = 1e-5};
    scene.stages.resize(1);
    scene.stages[0].name = "fall";
    scene.stages[0].duration = 0.02;
    scene.traces.resize(1);
    scene.observables.coarse_graining =
        CoarseGrainingObservable{.box = {{-2e-3, -2e-3, 0}, {4e-3, 4e-3, 4e-3}},
                                 .counts = {2, 2, 2},
                                 .kernel = Kernel::lucy,
                                 .reach = 2e-3};
    scene.output.field_interval = 3e-3;
    scene.output.frame_interval = 5e-3;
    scene.output.history_interval = 1e-3;
    scene.output.trace_interval = 1e-3;
    scene.output.checkpoint_interval = 8e-3;
    scene.output.contacts = true;
    return scene;
}

/// Runs from where the folder stands until `last_cycle` or the end; true at the end.
bool run(const std::filesystem::path& path, bool resume, std::uint64_t last_cycle) {
    const Scene scene = falling_spheres();
    RunFolder folder(path, "{}", scene, 1, {.resume = resume});
    Simulation simulation(scene, 0);
    if (const std::optional<Archive> state = folder.load_checkpoint().at(0)) {
        simulation.load(*state);
    }
    while (simulation.cycle() < last_cycle) {
        if (simulation.advance(100, folder.observer(0))) {
            folder.finish({});
            return true;
        }
    }
    return false;
}

TEST(RunObserver, KilledAndResumedRunLeavesTheSameFiles) {
    const TemporaryFolder folder;
    ASSERT_TRUE(run(folder / "straight", false, 1'000'000));
    ASSERT_FALSE(run(folder / "killed", false, 1300));
    ASSERT_TRUE(run(folder / "killed", true, 1'000'000));
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / "straight")) {
        if (entry.is_regular_file()) {
            const auto name = entry.path().lexically_relative(folder / "straight");
            EXPECT_TRUE(read_file(entry.path()) == read_file(folder / "killed" / name)) << name;
            ++count;
        }
    }
    // 5 frames of 3 files, 8 fields, 4 series, traces; scene, manifest, history, two checkpoints.
    EXPECT_EQ(count, 33U);
}

}  // namespace
}  // namespace grainbench::io
