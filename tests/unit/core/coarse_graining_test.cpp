#include "core/measure/smoothing_kernel.hpp"

#include "tests/support/observers.hpp"
#include "tests/support/scenes.hpp"
#include "tests/unit/core/measure_support.hpp"

#include <limits>

namespace grainbench::test {
namespace {

constexpr double round_off = 64 * std::numeric_limits<double>::epsilon();

/// Of sums over cells a tenth of the reach wide: measured 2.2e-7 for Lucy's polynomial, which ends
/// smoothly, and 5e-4 for the Gaussian, which ends in a step of a hundredth of its peak.
double of_grid(Kernel kernel) {
    return kernel == Kernel::lucy ? 1e-6 : 1e-3;
}

constexpr Kernel kernels[] = {Kernel::lucy, Kernel::gaussian};
constexpr double reach = 3.0 * radius;

// Kernels -----------------------------------------------------------------------------------------

TEST(SmoothingKernel, HasTheIntegralOneOverSpace) {
    for (const Kernel one : kernels) {
        const SmoothingKernel kernel(one, reach);
        constexpr int shells = 20000;  // midpoint rule: 1 / shells^2 and a little
        const double width = reach / shells;
        double sum = 0.0;
        for (int k = 0; k < shells; ++k) {
            const double r = (k + 0.5) * width;
            sum += 4.0 * pi * r * r * kernel.at(r * r) * width;
        }
        EXPECT_NEAR(sum, 1.0, 1e-7);
        EXPECT_EQ(kernel.at(1.01 * reach * reach), 0.0);
    }
}

TEST(SmoothingKernel, LineIntegralIsThatOfTheKernel) {
    for (const Kernel one : kernels) {
        const SmoothingKernel kernel(one, reach);
        for (const double off : {0.0, 0.3, 0.9, 0.999}) {
            for (const auto& [from, to] : std::initializer_list<std::pair<double, double>>{
                     {-0.7, 0.2}, {0.1, 0.4}, {-2.0, 2.0}, {0.8, 3.0}, {1.1, 1.2}}) {
                const double square = off * off * reach * reach;
                constexpr int parts = 40000;  // midpoint rule; the Gaussian's step costs one part
                const double length = (to - from) * reach;
                double sum = 0.0;
                for (int k = 0; k < parts; ++k) {
                    const double u = from * reach + (k + 0.5) * length / parts;
                    sum += kernel.at(square + u * u) * length / parts;
                }
                EXPECT_NEAR(kernel.along_line(square, from * reach, to * reach),
                            sum,
                            1e-5 * kernel.at(0.0) * reach)
                    << off << " from " << from << " to " << to;
            }
        }
    }
}

// Fields ------------------------------------------------------------------------------------------

/// Cells a tenth of the kernels' reach wide.
CoarseGrainingObservable grid(const Vec3& low, const Vec3& high, Kernel kernel) {
    constexpr double width = 0.3 * radius;
    const auto count = [](double edge) { return std::llround(edge / width); };
    return {.box = {low, high},
            .counts = {count(high.x - low.x), count(high.y - low.y), count(high.z - low.z)},
            .kernel = kernel,
            .reach = reach};
}

double cell_volume(const FieldFrame& f) {
    return f.spacing.x * f.spacing.y * f.spacing.z;
}

FieldFrame fields_of(const Scene& scene) {
    return Simulation(scene, 0).field_frame();
}

/// Three spheres in motion, and room for any kernel about them.
Scene moving_spheres(Kernel kernel) {
    Scene scene = still_scene({{0, 0, 0}, {0.021, 0.001, 0}, {0.002, 0.019, 0.013}});
    auto& list = std::get<ListInsertion>(scene.particles.insertion[0]).particles;
    list[0].velocity = {1.0, -2.0, 0.5};
    list[1].velocity = {0.3, 0.1, -4.0};
    list[2].velocity = {-2.0, 1.0, 1.0};
    scene.observables.coarse_graining =
        grid({-0.033, -0.033, -0.033}, {0.057, 0.057, 0.057}, kernel);
    return scene;
}

TEST(CoarseGraining, ConservesMassVolumeAndMomentum) {
    for (const Kernel kernel : kernels) {
        const FieldFrame f = fields_of(moving_spheres(kernel));
        double sum = 0.0;
        double volume = 0.0;
        Vec3 momentum{};
        for (std::size_t c = 0; c < f.density.size(); ++c) {
            sum += f.density[c] * cell_volume(f);
            volume += f.solid_fraction[c] * cell_volume(f);
            momentum += f.density[c] * cell_volume(f) * f.velocity[c];
        }
        EXPECT_NEAR(sum, 3.0 * mass, of_grid(kernel) * mass);
        EXPECT_NEAR(volume, 3.0 * mass / density, of_grid(kernel) * mass / density);
        EXPECT_LT(norm(momentum - mass * Vec3{-0.7, -0.9, -2.5}), of_grid(kernel) * mass * 4.0);
    }
}

TEST(CoarseGraining, KineticStressHoldsTheEnergyThatTheMeanMotionLeaves) {
    for (const Kernel kernel : kernels) {
        const FieldFrame f = fields_of(moving_spheres(kernel));
        double twice = 0.0;
        for (std::size_t c = 0; c < f.density.size(); ++c) {
            twice += (3.0 * f.density[c] * f.granular_temperature[c] +
                      f.density[c] * dot(f.velocity[c], f.velocity[c])) *
                     cell_volume(f);
        }
        const double expected = mass * (5.25 + 16.1 + 6.0);
        EXPECT_NEAR(twice, expected, of_grid(kernel) * expected);
    }
}

TEST(CoarseGraining, WhatMovesAsOneIsCold) {
    const Vec3 velocity{30.0, -20.0, 70.0};
    for (const Kernel kernel : kernels) {
        Scene scene = moving_spheres(kernel);
        for (Placement& sphere : std::get<ListInsertion>(scene.particles.insertion[0]).particles) {
            sphere.velocity = velocity;
        }
        const FieldFrame f = fields_of(scene);
        for (std::size_t c = 0; c < f.density.size(); ++c) {
            EXPECT_LT(f.granular_temperature[c], std::pow(round_off * norm(velocity), 2.0));
            if (f.density[c] > 0.0) {
                EXPECT_LT(norm(f.velocity[c] - velocity), round_off * norm(velocity));
            }
        }
    }
}

TEST(CoarseGraining, TwoBeamsHaveTheTemperatureOfTheirSpeed) {
    Scene scene = still_scene({{-0.011, 0, 0}, {0.011, 0, 0}});
    auto& list = std::get<ListInsertion>(scene.particles.insertion[0]).particles;
    list[0].velocity = {0.0, 3.0, 0.0};
    list[1].velocity = {0.0, -3.0, 0.0};
    scene.observables.coarse_graining =
        CoarseGrainingObservable{.box = {{-0.003, -0.003, -0.003}, {0.003, 0.003, 0.003}},
                                 .counts = {1, 1, 1},
                                 .kernel = Kernel::lucy,
                                 .reach = 0.03};
    const FieldFrame f = fields_of(scene);
    EXPECT_EQ(f.velocity.at(0), Vec3{});
    EXPECT_NEAR(f.granular_temperature.at(0), 9.0 / 3.0, 3.0 * round_off);
    EXPECT_NEAR(f.kinetic_stress.at(0)[4], f.density[0] * 9.0, f.density[0] * 9.0 * round_off);
    EXPECT_EQ(f.kinetic_stress.at(0)[0], 0.0);
}

/// Sum over the grid of the contact stress [Pa m^3].
Tensor summed_stress(const FieldFrame& f) {
    Tensor sum{};
    for (const Tensor& stress : f.contact_stress) {
        for (std::size_t k = 0; k < 9; ++k) {
            sum[k] += stress[k] * cell_volume(f);
        }
    }
    return sum;
}

void expect_is(const Tensor& found, const Tensor& expected, double tolerance) {
    for (std::size_t k = 0; k < 9; ++k) {
        EXPECT_NEAR(found[k], expected[k], tolerance) << "component " << k;
    }
}

TEST(CoarseGraining, StressOfACompressedPairIsForceTimesBranch) {
    const double overlap = 0.05 * radius;
    const double force = stiffness * overlap;
    const double branch = 2.0 * radius - overlap;
    const Vec3 n = normalized({2, -1, 2});  // (2, -1, 2) / 3
    for (const Kernel kernel : kernels) {
        Scene scene = still_scene({{0, 0, 0}, branch * n});
        scene.observables.coarse_graining =
            grid({-0.033, -0.042, -0.033}, {0.051, 0.033, 0.051}, kernel);
        expect_is(summed_stress(fields_of(scene)),
                  {force * branch * 4.0 / 9.0,
                   force * branch * -2.0 / 9.0,
                   force * branch * 4.0 / 9.0,
                   force * branch * -2.0 / 9.0,
                   force * branch * 1.0 / 9.0,
                   force * branch * -2.0 / 9.0,
                   force * branch * 4.0 / 9.0,
                   force * branch * -2.0 / 9.0,
                   force * branch * 4.0 / 9.0},
                  of_grid(kernel) * force * branch);
    }
}

TEST(CoarseGraining, StressInTheMiddleOfAPairIsTheLineIntegralAndNotItsMidpoint) {
    const double overlap = 0.05 * radius;
    const double branch = 2.0 * radius - overlap;
    Scene scene = still_scene({{-0.5 * branch, 0, 0}, {0.5 * branch, 0, 0}});
    scene.observables.coarse_graining =
        CoarseGrainingObservable{.box = {{-0.001, -0.001, -0.001}, {0.001, 0.001, 0.001}},
                                 .counts = {1, 1, 1},
                                 .kernel = Kernel::lucy,
                                 .reach = branch};
    // Of (2) in smoothing_kernel.hpp from -1/2 to 1/2: 1 - 1/2 + 1/4 - 3/80 = 57/80.
    const double expected = stiffness * overlap * 105.0 / (16.0 * pi * branch * branch) * 57.0 / 80;
    const FieldFrame f = fields_of(scene);
    EXPECT_NEAR(f.contact_stress.at(0)[0], expected, 1e-12 * expected);
    EXPECT_NEAR(f.pressure.at(0), expected / 3.0, 1e-12 * expected);
}

TEST(CoarseGraining, StressAtAWallEndsAtTheContactPoint) {
    const double overlap = 0.05 * radius;
    Scene scene = still_scene({{0, 0, radius - overlap}});
    scene.walls = {floor_at({0, 0, 0}, {0, 0, 1})};
    const double expected = stiffness * overlap * (radius - 0.5 * overlap);
    for (const Kernel kernel : kernels) {
        scene.observables.coarse_graining =
            grid({-0.033, -0.033, -0.033}, {0.033, 0.033, 0.045}, kernel);
        expect_is(summed_stress(fields_of(scene)),
                  {0, 0, 0, 0, 0, 0, 0, 0, expected},
                  of_grid(kernel) * expected);
    }
}

/// In equilibrium the divergence of the stress is the weight, for any kernel: what crosses a plane
/// is what lies above it.
TEST(CoarseGraining, StressInAStandingColumnIsTheWeightAbove) {
    constexpr int count = 8;
    constexpr double g = 9.8;
    // Half a layer, taken by its middle: h^2/8 of the slope of the density, 2.7e-4 by an
    // integration of its own.
    constexpr double of_half_layer = 3e-4;
    std::vector<Vec3> positions;
    double z = radius;
    for (int k = 0; k < count; ++k) {
        z -= (count - k) * mass * g / stiffness;  // overlap below sphere k
        positions.push_back({0, 0, z});
        z += 2.0 * radius;
    }
    for (const Kernel kernel : kernels) {
        Scene scene = still_scene(positions);
        scene.gravity = Vec3{0, 0, -g};
        scene.walls = {floor_at({0, 0, 0}, {0, 0, 1})};
        // From where neither the force of the floor nor that of the lowest sphere on it is seen.
        scene.observables.coarse_graining =
            grid({-0.033, -0.033, 0.042}, {0.033, 0.033, 0.042 + 0.15}, kernel);
        const FieldFrame f = fields_of(scene);
        const double area = f.spacing.x * f.spacing.y;
        double above = 0.0;
        for (std::size_t k = f.counts[2]; k-- > 0;) {
            double layer = 0.0;
            double crossing = 0.0;
            for (std::size_t c = 0; c < std::size_t{f.counts[0]} * f.counts[1]; ++c) {
                layer += f.density[k * f.counts[0] * f.counts[1] + c] * area * f.spacing.z * g;
                crossing += f.contact_stress[k * f.counts[0] * f.counts[1] + c][8] * area;
            }
            EXPECT_NEAR(
                crossing, above + 0.5 * layer, (of_half_layer + of_grid(kernel)) * count * mass * g)
                << "layer " << k;
            above += layer;
        }
        EXPECT_GT(above, 4.0 * mass * g);
    }
}

TEST(CoarseGraining, SeesAcrossPeriodicBoundaries) {
    const double overlap = 0.05 * radius;
    const double branch = 2.0 * radius - overlap;
    const double period = 0.09;
    // In contact across the boundary along x; the second also near that along y.
    Scene scene = still_scene(
        {{0.3 * radius, 0.5 * radius, 0}, {0.3 * radius - branch + period, 0.5 * radius, 0}});
    scene.periodic =
        Periodic{.x = Interval{0.0, period}, .y = Interval{0.0, period}, .z = std::nullopt};
    for (const Kernel kernel : kernels) {
        scene.observables.coarse_graining = grid({0, 0, -0.033}, {period, period, 0.033}, kernel);
        const FieldFrame f = fields_of(scene);
        double sum = 0.0;
        for (const double one : f.density) {
            sum += one * cell_volume(f);
        }
        EXPECT_NEAR(sum, 2.0 * mass, 2.0 * of_grid(kernel) * mass);
        const double expected = stiffness * overlap * branch;
        expect_is(summed_stress(f), {expected, 0, 0, 0, 0, 0, 0, 0, 0}, of_grid(kernel) * expected);
    }
}

// When they are due -------------------------------------------------------------------------------

/// Keeps times and fields.
class FieldRecorder : public Observer {
public:
    void on_frame(const Simulation& simulation) override {
        frame_times.push_back(simulation.time());
    }

    void on_fields(const Simulation& simulation) override {
        const FieldFrame f = simulation.field_frame();
        times.push_back(f.time);
        pressures.push_back(bits(f.pressure));
    }

    std::vector<double> frame_times, times;
    std::vector<std::vector<std::uint64_t>> pressures;
};

Scene bed_with_fields() {
    Scene scene = thrown_bed();
    scene.observables.coarse_graining =
        CoarseGrainingObservable{.box = {{-0.02, -0.02, -0.03}, {0.02, 0.02, 0.03}},
                                 .counts = {4, 4, 6},
                                 .kernel = Kernel::lucy,
                                 .reach = 0.01};
    scene.output.frame_interval = 0.004;
    return scene;
}

/// The ledger keeps the records of every step; without it only those of steps that are looked at.
TEST(CoarseGraining, IsTheSameWhetherContactsLeaveRecordsAlwaysOrOnlyWhenDue) {
    FieldRecorder always;
    FieldRecorder when_due;
    Scene scene = bed_with_fields();
    Simulation(scene, 0).advance(1U << 30, always);
    scene.observables.energy.reset();
    scene.guards.energy.action = GuardAction::ignore;  // its looks leave records as well
    Simulation(scene, 0).advance(1U << 30, when_due);
    EXPECT_EQ(always.times, always.frame_times);
    EXPECT_EQ(always.times, when_due.times);
    EXPECT_EQ(always.pressures, when_due.pressures);
    EXPECT_GT(always.times.size(), 10U);
}

TEST(CoarseGraining, ComesAtAnIntervalOfItsOwn) {
    FieldRecorder record;
    Scene scene = bed_with_fields();
    scene.observables.energy.reset();
    scene.guards.energy.action = GuardAction::ignore;
    scene.output.field_interval = 0.007;
    Simulation(scene, 0).advance(1U << 30, record);
    // 0, 4 times in the 0.03 s of the first stage, once in the 0.01 s of the second, the end.
    ASSERT_EQ(record.times.size(), 7U);
    EXPECT_NEAR(record.times[2], 0.014, 1e-4);
    EXPECT_NE(record.times.size(), record.frame_times.size());
}

TEST(CoarseGraining, IsRefusedWhereNothingIsDueOrAskedFor) {
    Scene scene = bed_with_fields();
    scene.observables.energy.reset();
    scene.guards.energy.action = GuardAction::ignore;
    Simulation simulation(scene, 0);
    Observer nobody;
    simulation.advance(11, nobody);
    EXPECT_THROW(simulation.field_frame(), Error);
    EXPECT_THROW(fields_of(thrown_bed()), Error);
}

}  // namespace
}  // namespace grainbench::test
