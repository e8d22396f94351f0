#include "core/simulation.hpp"

#include "tests/support/scenes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace grainbench {
namespace {

class Recorder : public PhaseWatch {
public:
    void enter(Phase phase) override { entered.push_back(phase); }

    std::vector<Phase> entered;
};

/// The sequence of share/doc/architecture.md; lists of pairs come before walls in both halves.
TEST(Phases, AreToldInTheOrderOfTheCycle) {
    Simulation simulation(test::gas_in_box(1), 0);
    Observer nobody;
    simulation.advance(1, nobody);
    Recorder recorder;
    simulation.watch_phases(&recorder);
    simulation.advance(1, nobody);
    simulation.watch_phases(nullptr);
    simulation.advance(1, nobody);
    EXPECT_THAT(recorder.entered,
                ::testing::ElementsAre(Phase::timestep,
                                       Phase::integration,
                                       Phase::detection,
                                       Phase::walls,
                                       Phase::detection,
                                       Phase::walls,
                                       Phase::contacts,
                                       Phase::walls,
                                       Phase::output));
}

/// Exact: who looks on must not change what happens.
TEST(Phases, LeaveTheBitsAlone) {
    Simulation watched(test::gas_in_box(2), 0);
    Simulation alone(test::gas_in_box(2), 0);
    Observer nobody;
    Recorder recorder;
    watched.watch_phases(&recorder);
    watched.advance(300, nobody);
    alone.advance(300, nobody);
    EXPECT_EQ(watched.state_hash(), alone.state_hash());
}

}  // namespace
}  // namespace grainbench
