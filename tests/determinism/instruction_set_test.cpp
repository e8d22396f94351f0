/// Every instruction set of this processor steps a whole run to the same bits.
#include "core/kernels/kernels.hpp"
#include "core/simulation.hpp"

#include "tests/support/observers.hpp"
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

namespace grainbench::test {
namespace {

void expect_same_hash_on_every_set(const Scene& scene, std::uint64_t cycles) {
    Observer nobody;
    Simulation scalar(scene, 0, {.isa = "scalar"});
    scalar.advance(cycles, nobody);
    ASSERT_GT(scalar.touching_count(), 100U);
    for (std::size_t n = 0; !available_isa(n).empty(); ++n) {
        Simulation simulation(scene, 0, {.isa = std::string(available_isa(n))});
        simulation.advance(cycles, nobody);
        EXPECT_EQ(simulation.state_hash(), scalar.state_hash()) << available_isa(n);
    }
}

TEST(InstructionSet, ShakenBedHasTheSameHash) {
    expect_same_hash_on_every_set(shaken_bed(), 7000);
}

TEST(InstructionSet, ThrownBedHasTheSameHash) {
    expect_same_hash_on_every_set(thrown_bed(), 1400);
}

}  // namespace
}  // namespace grainbench::test
