/// Scenes that repeat themselves: what leaves at one end comes back at the other, and contacts
/// reach across.
#include "core/engine.hpp"

#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace grainbench::test {
namespace {

void finish(Simulation& simulation) {
    Observer nobody;
    simulation.advance(1U << 30, nobody);
}

Scene two_balls(double x, double y, bool periodic) {
    Scene scene;
    scene.particles.species = {{"ball", 0.003, 1500.0}};
    scene.particles.insertion = {ListInsertion{
        .particles = {{"ball", {x - 0.004, y, 0.0}, {0.5, 0.1, 0.0}, {0.0, 0.0, 30.0}},
                      {"ball", {x + 0.004, y + 0.001, 0.0}, {-0.5, 0.1, 0.2}, {}}}}};
    if (periodic) {
        scene.periodic = Periodic{.x = Interval{-0.03, 0.03}, .y = Interval{-0.03, 0.03}, .z = {}};
    }
    scene.contact = full_contact(1e4, 0.1);
    scene.timestep = FixedTimestep{1e-6};
    scene.traces = {{.nearest_to = {x - 0.004, y, 0.0}, .species = {}},
                    {.nearest_to = {x + 0.004, y, 0.0}, .species = {}}};
    Stage stage;
    stage.duration = 0.01;
    scene.stages = {stage};
    return scene;
}

/// Round-off of places of 0.03 m, 3e-18, over an overlap of 1e-4 m, in 1000 steps of contact.
constexpr double round_off = 1e-10;

TEST(Periodic, AnImpactAcrossAnEdgeIsTheOneInTheMiddle) {
    Simulation inside(two_balls(0.0, 0.0, false), 0);
    finish(inside);
    ASSERT_GT(norm(inside.particle_frame().velocity[0] - Vec3{0.5, 0.1, 0.0}), 0.1);
    const Vec3 spin = inside.particle_frame().angular_velocity[0];
    const auto expect_alike = [&](double x, double y) {
        SCOPED_TRACE("at " + std::to_string(x) + ", " + std::to_string(y));
        Simulation across(two_balls(x, y, true), 0);
        finish(across);
        for (const std::size_t ball : {0U, 1U}) {
            const TracePoint a = inside.trace_points()[ball];
            const TracePoint b = across.trace_points()[ball];
            EXPECT_LT(norm(a.velocity - b.velocity), round_off);
            EXPECT_LT(norm(a.position + Vec3{x, y, 0.0} - b.position), round_off);
        }
        EXPECT_LT(norm(across.particle_frame().angular_velocity[0] - spin), 1e3 * round_off);
        for (const Vec3& p : across.particle_frame().position) {
            EXPECT_TRUE(p.x >= -0.03 && p.x <= 0.03 && p.y >= -0.03 && p.y <= 0.03);
        }
    };
    expect_alike(0.03, 0.0);
    expect_alike(-0.03, 0.01);
    expect_alike(0.0005, 0.0295);
    expect_alike(0.0299, -0.0297);  // past a corner
}

TEST(Periodic, MomentumStays) {
    Scene scene = gas_in_box(7);
    scene.gravity = {};
    scene.walls = {};
    scene.periodic = Periodic{
        .x = Interval{-0.045, 0.045}, .y = Interval{-0.045, 0.045}, .z = Interval{-0.045, 0.045}};
    scene.stages[0].duration = 0.3;
    Simulation simulation(scene, 0);
    const auto momentum = [&] {
        const ParticleFrame frame = simulation.particle_frame();
        Vec3 sum{};
        double size = 0.0;
        for (std::size_t n = 0; n < frame.size(); ++n) {
            const Species& species =
                scene.particles.species[static_cast<std::size_t>(frame.species[n])];
            const double mass = sphere_mass(species.density, species.radius);
            sum += mass * frame.velocity[n];
            size += mass * norm(frame.velocity[n]);
        }
        return std::pair{sum, size};
    };
    const auto [before, size] = momentum();
    finish(simulation);
    EXPECT_GT(simulation.summary().candidate_builds, 10U);
    EXPECT_LT(norm(momentum().first - before), 1e-12 * size);  // round-off of 15000 steps
}

/// The reference engine makes images of all particles, once, and lists every pair. Sums come in the
/// same order; only a particle that was put back, where it stands, is rounded otherwise.
TEST(Periodic, ListsMissNothing) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        Scene scene = gas_in_box(seed);
        scene.walls.resize(0);
        scene.gravity = {};
        scene.periodic = Periodic{.x = Interval{-0.045, 0.045},
                                  .y = Interval{-0.045, 0.045},
                                  .z = Interval{-0.045, 0.045}};
        Simulation fast(scene, 0);
        Simulation reference(scene, 0, {.isa = "", .reference = true});
        Observer nobody;
        std::size_t touches = 0;
        for (int step = 0; step < 800; ++step) {
            fast.advance(1, nobody);
            reference.advance(1, nobody);
            touches += fast.touching_count();
            ASSERT_EQ(fast.touching_count(), reference.touching_count()) << "step " << step;
        }
        EXPECT_GT(touches, 300U);
        const ParticleFrame a = fast.particle_frame();
        const ParticleFrame b = reference.particle_frame();
        for (std::size_t n = 0; n < a.size(); ++n) {
            EXPECT_LT(norm(a.velocity[n] - b.velocity[n]), 1e-9);
        }
    }
}

/// A slant bed that friction holds on a belt passes its period many times. Each time images are
/// made anew, and contacts must not start from nothing: they would let the bed slip.
TEST(Periodic, FrictionLastsFromPeriodToPeriod) {
    Scene scene = carried_bed();
    scene.stages[0].duration = 0.4;
    Simulation simulation(scene, 0);
    finish(simulation);
    EXPECT_GT(simulation.trace_points()[0].position.x, 5.0 * 0.03);
    const ParticleFrame frame = simulation.particle_frame();
    double fastest = 0.0;
    std::size_t held = 0;
    for (std::size_t n = 0; n < frame.size(); ++n) {
        if (frame.contacts[n] >= 3) {  // nothing brakes what rolls freely
            ++held;
            fastest = std::max(fastest, norm(frame.velocity[n] - Vec3{0.5, 0.0, 0.0}));
        }
    }
    EXPECT_GT(held, 60U);
    EXPECT_LT(fastest, 1e-4);
}

/// Gravity along a periodic direction supplies energy for ever: a fall of many periods is a fall.
TEST(Periodic, LedgerKnowsHowFarThingsFell) {
    Scene scene = two_balls(0.0, 0.0, true);
    scene.gravity = Vec3{9.8, 0.0, 0.0};
    scene.timestep = FixedTimestep{1e-5};
    scene.observables.energy = EnergyObservable{};
    scene.stages[0].duration = 0.3;
    Simulation simulation(scene, 0);
    finish(simulation);
    const double energy = [&] {
        const auto& columns = simulation.history_columns();
        const auto at = std::find_if(columns.begin(), columns.end(), [](const auto& column) {
            return column.name == "energy_residual";
        });
        return simulation.history_row()[static_cast<std::size_t>(at - columns.begin())];
    }();
    EXPECT_GT(simulation.trace_points()[0].position.x, 5.0 * 0.06);
    EXPECT_LT(std::abs(energy), 1e-12);  // of 1e-2 J: round-off
}

TEST(Periodic, RefusesAnIntervalTooNarrowForItsParticles) {
    Scene scene = two_balls(0.0, 0.0, true);
    scene.periodic->y = Interval{0.0, 0.01};
    try {
        Simulation simulation(scene, 0);
        FAIL() << "accepted";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::bad_input);
        EXPECT_EQ(error.diagnosis().where, "/periodic/y");
    }
}

}  // namespace
}  // namespace grainbench::test
