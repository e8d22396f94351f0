// Guards: what they stop, what they say, and that they stay silent where all is well.
#include "core/error.hpp"
#include "core/simulation.hpp"

#include "tests/support/observers.hpp"
#include "tests/support/scenes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace grainbench::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// One ball over a floor.
Scene ball_over_floor(double height, double speed, double step) {
    Scene scene;
    scene.particles.species = {{.name = "ball", .radius = 0.01, .density = 1000.0}};
    scene.particles.insertion.emplace_back(ListInsertion{
        {{.species = "ball", .position = {0.0, 0.0, height}, .velocity = {0.0, 0.0, -speed}}}});
    Wall floor;
    floor.name = "floor";
    floor.shape = Plane{.point = {}, .normal = {0.0, 0.0, 1.0}};
    scene.walls.push_back(floor);
    scene.contact.stiffness = ConstantStiffness::Params{.normal = 1e4};
    scene.timestep = FixedTimestep{.value = step};
    Stage stage;
    stage.duration = 1000.0 * step;
    scene.stages.push_back(stage);
    return scene;
}

std::string stopped_with(const Scene& scene) {
    Simulation simulation(scene, 0);
    Observer nothing;
    try {
        simulation.advance(1U << 30U, nothing);
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::unstable);
        return error.what();
    }
    return "ran to its end";
}

std::vector<std::string> warnings_of(const Scene& scene) {
    Simulation simulation(scene, 0);
    Observer nothing;
    simulation.advance(1U << 30U, nothing);
    return simulation.summary().warnings;
}

TEST(Guards, NameParticlePlaceTimePartnersCauseAndChange) {
    // A soft floor, met at a speed that takes the ball halfway through.
    const Scene scene = ball_over_floor(0.0101, 15.0, 1e-5);
    EXPECT_THAT(stopped_with(scene),
                AllOf(HasSubstr("particle 1 (ball) overlaps by"),
                      HasSubstr("at (0, 0, "),
                      HasSubstr("touching wall 'floor'"),
                      HasSubstr("cycle 57, time 0.00057 s, timestep 1e-05 s"),
                      HasSubstr("likely cause: contacts too soft"),
                      HasSubstr("next step: make /contact/stiffness")));
}

TEST(Guards, StopABallThatWouldPassTheFloorInOneCycle) {
    EXPECT_THAT(stopped_with(ball_over_floor(1.0, 600.0, 1e-5)), HasSubstr("moved by 0.6 of"));
    EXPECT_EQ(stopped_with(ball_over_floor(100.0, 400.0, 1e-5)), "ran to its end");
}

TEST(Guards, StopWhatIsNotFiniteOrBeyondAllMeasure) {
    for (const double speed : {1e300, 1e200, 1e40}) {
        Scene scene = ball_over_floor(1.0, speed, 1e-5);
        scene.guards.speed.action = GuardAction::ignore;
        EXPECT_THAT(stopped_with(scene), HasSubstr("particle 1 (ball) has a velocity or position"));
    }
}

TEST(Guards, BlameAStepAboveTheLimitOfOneContact) {
    // m = 4.19 g, k = 1e4 N/m: stable below sqrt(m / k) = 6.5e-4 s by the estimate.
    Scene scene = ball_over_floor(0.00999, 0.01, 3e-3);
    scene.gravity = Vec3{0.0, 0.0, -9.8};
    EXPECT_THAT(
        stopped_with(scene),
        AllOf(HasSubstr("likely cause: the fixed step is 4.6"), HasSubstr("leave out /timestep")));
}

TEST(Guards, KeepAWarningWhereTheSceneSaysWarn) {
    Scene scene = ball_over_floor(0.0101, 15.0, 1e-5);
    scene.guards.overlap.action = GuardAction::warn;
    scene.stages[0].duration = 0.005;
    const std::vector<std::string> warnings = warnings_of(scene);
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_THAT(warnings[0], HasSubstr("overlaps by"));
    scene.guards.overlap.action = GuardAction::ignore;
    EXPECT_TRUE(warnings_of(scene).empty());
}

TEST(Guards, CountWhatLeftTheDomainOrItsSideOfAPlane) {
    Scene scene = ball_over_floor(0.5, 1.0, 1e-4);
    scene.guards.lost.domain = Box{{-1.0, -1.0, 0.45}, {1.0, 1.0, 1.0}};
    EXPECT_THAT(warnings_of(scene), testing::ElementsAre(HasSubstr("1 particles left the domain")));
    scene.guards.lost.action = LostAction::stop;
    EXPECT_THAT(stopped_with(scene), HasSubstr("has left the domain"));
    // Through a floor that is too soft to turn it round.
    Scene soft = ball_over_floor(0.0101, 300.0, 1e-5);
    soft.guards.overlap.action = GuardAction::ignore;
    EXPECT_THAT(warnings_of(soft), testing::ElementsAre(HasSubstr("1 particles left")));
}

/// Two that touch and stay, one that rises out of the domain.
Scene one_leaves_two() {
    Scene scene = ball_over_floor(0.0, 0.0, 1e-4);
    scene.particles.insertion = {ListInsertion{
        {{.species = "ball", .position = {0.0, 0.0, 0.1}, .velocity = {0.0, 0.0, 10.0}},
         {.species = "ball", .position = {0.0, 0.0, 0.01}},
         {.species = "ball", .position = {0.0199, 0.0, 0.01}}}}};
    scene.contact.damping = ViscousDamping::Params{.normal = 0.1, .shear = 0.1};
    scene.guards.lost.domain = Box{{-1.0, -1.0, -1.0}, {1.0, 1.0, 0.2}};
    scene.guards.lost.action = LostAction::remove;
    return scene;
}

TEST(Guards, DeleteAndCountTheLostWhereTheSceneSaysSo) {
    const Scene scene = one_leaves_two();
    Simulation simulation(scene, 0);
    Observer nothing;
    simulation.advance(1U << 30U, nothing);
    EXPECT_EQ(simulation.particle_count(), 2U);
    const auto& columns = simulation.history_columns();
    const auto lost = std::find_if(columns.begin(), columns.end(), [](const HistoryColumn& one) {
        return one.name == "lost";
    });
    ASSERT_NE(lost, columns.end());
    EXPECT_EQ(simulation.history_row()[static_cast<std::size_t>(lost - columns.begin())], 1.0);
    EXPECT_THAT(simulation.summary().warnings, testing::ElementsAre(HasSubstr("were deleted")));
    const ParticleFrame frame = simulation.particle_frame();
    EXPECT_THAT(frame.id, testing::ElementsAre(2, 3));

    // Those that stay go their way as if there had never been a third.
    Scene others = scene;
    std::get<ListInsertion>(others.particles.insertion[0])
        .particles.erase(std::get<ListInsertion>(others.particles.insertion[0]).particles.begin());
    Simulation without(others, 0);
    without.advance(1U << 30U, nothing);
    EXPECT_EQ(without.particle_frame().position[0], frame.position[0]);
    EXPECT_EQ(without.particle_frame().position[1], frame.position[1]);
}

TEST(Guards, DeleteTheSameAfterARestart) {
    const Scene scene = one_leaves_two();
    Simulation straight(scene, 0);
    Observer nothing;
    straight.advance(1U << 30U, nothing);
    for (const std::uint64_t saved_at : {0U, 200U, 256U, 700U}) {  // the ball goes at cycle 256
        Simulation first(scene, 0);
        first.advance(saved_at, nothing);
        Archive archive;
        first.save(archive);
        Simulation second(scene, 0);
        second.load(archive);
        second.advance(1U << 30U, nothing);
        EXPECT_EQ(second.state_hash(), straight.state_hash()) << "saved at cycle " << saved_at;
    }
}

TEST(Guards, WarnOfAStepBarelyAboveTheCriticalOne) {
    // For large balls among many small ones that stick: up to 1.1 of the critical step at times.
    Scene bed = shaken_bed();
    bed.timestep = FixedTimestep{.value = 1.1e-5};
    EXPECT_THAT(warnings_of(bed), testing::ElementsAre(HasSubstr("small motions grow by 1.")));
}

TEST(Guards, AreSilentInAShakenBed) {
    Scene bed = shaken_bed();
    bed.timestep = FixedTimestep{.value = 8e-6};
    EXPECT_THAT(warnings_of(bed), testing::IsEmpty());
    EXPECT_THAT(warnings_of(gas_in_box(1)), testing::IsEmpty());
    EXPECT_THAT(warnings_of(thrown_bed()), testing::IsEmpty());
}

}  // namespace
}  // namespace grainbench::test
