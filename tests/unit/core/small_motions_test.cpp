// Growth of small motions at a step, against frequencies that are known.
#include "core/integrate/small_motions.hpp"

#include "core/engine.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace grainbench::test {
namespace {

constexpr double radius = 0.01;
constexpr double density = 1000.0;
constexpr double k_n = 1e4;
constexpr double k_s = 1e4;
const double mass = 4.0 / 3.0 * pi * radius * radius * radius * density;

Scene scene_with(std::vector<Placement> placements) {
    Scene scene;
    scene.particles.species = {{.name = "ball", .radius = radius, .density = density}};
    scene.particles.insertion.emplace_back(ListInsertion{std::move(placements)});
    scene.contact.stiffness = ConstantStiffness::Params{.normal = k_n, .shear = k_s};
    Stage stage;
    stage.duration = 1.0;
    scene.stages.push_back(stage);
    return scene;
}

/// A ball that touches a plane.
Scene ball_on_plane() {
    Scene scene = scene_with({{.species = "ball", .position = {0.0, 0.0, 0.9999 * radius}}});
    Wall floor;
    floor.name = "floor";
    floor.shape = Plane{.point = {}, .normal = {0.0, 0.0, 1.0}};
    scene.walls.push_back(floor);
    return scene;
}

/// Growth per cycle at a step [s].
double growth_at(const Scene& scene, double step) {
    Engine engine(scene, 1, {});
    engine.begin_stage(scene.stages[0]);
    return engine.compute_growth(step);
}

/// Of an undamped mode of frequency w, where x = w dt > 2: the larger root of g + 1/g = x^2 - 2.
double exact_growth(double x) {
    const double half = 0.5 * x * x - 1.0;
    return half + std::sqrt(half * half - 1.0);
}

void expect_critical(const Scene& scene, double frequency) {
    for (const double factor : {0.3, 0.7, 0.97, 0.995}) {
        EXPECT_LT(growth_at(scene, 2.0 * factor / frequency), SmallMotions::least_growth) << factor;
    }
    for (const double factor : {1.05, 1.2, 1.5, 2.5}) {
        const double exact = exact_growth(2.0 * factor);
        // What other modes add to the noise has not quite gone.
        EXPECT_NEAR(growth_at(scene, 2.0 * factor / frequency) / exact, 1.0, 0.01) << factor;
    }
}

TEST(SmallMotions, OfABallOnAPlaneGrowFromItsCriticalStepOn) {
    expect_critical(ball_on_plane(), std::sqrt(k_n / mass));
}

TEST(SmallMotions, OfAStickingBallGrowByItsRolling) {
    Scene scene = ball_on_plane();
    scene.contact.friction = CoulombFriction::Params{.coefficient = 0.5};
    // Translation k_s / m and rotation k_s R^2 / (2/5 m R^2) are one mode.
    expect_critical(scene, std::sqrt(3.5 * k_s / mass));
    // A spring against rolling stiffens the rotation: {1 -1; -2.5 5} k_s / m.
    scene.contact.rolling = RollingResistance::Params{.coefficient = 0.1, .stiffness_ratio = 1.0};
    expect_critical(scene, std::sqrt((3.0 + std::sqrt(6.5)) * k_s / mass));
}

TEST(SmallMotions, OfAStickingPairGrowByItsSevenHalves) {
    Scene scene = scene_with({{.species = "ball", .position = {}},
                              {.species = "ball", .position = {0.0, 1.9999 * radius, 0.0}}});
    scene.contact.friction = CoulombFriction::Params{.coefficient = 0.5};
    expect_critical(scene, std::sqrt(7.0 * k_s / mass));
}

TEST(SmallMotions, OfADampedBallGrowSooner) {
    for (const double beta : {0.1, 0.3, 0.6, 0.9}) {
        Scene scene = ball_on_plane();
        scene.contact.damping = ViscousDamping::Params{.normal = beta};
        const double critical = 2.0 * (std::sqrt(1.0 + beta * beta) - beta) / std::sqrt(k_n / mass);
        EXPECT_LT(growth_at(scene, 0.97 * critical), SmallMotions::least_growth) << beta;
        EXPECT_GT(growth_at(scene, 1.2 * critical), SmallMotions::least_growth) << beta;
    }
}

TEST(SmallMotions, OfWhatTouchesNothingDoNotGrow) {
    const Scene scene = scene_with({{.species = "ball", .position = {}}});
    EXPECT_DOUBLE_EQ(growth_at(scene, 1.0), 1.0);
}

}  // namespace
}  // namespace grainbench::test
