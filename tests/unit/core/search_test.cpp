/// Candidate pairs against brute force, and the clock that says when they are stale.
#include "core/search/travel_clock.hpp"

#include "tests/unit/core/search_support.hpp"

#include <gtest/gtest.h>

namespace grainbench {
namespace {

/// Exact: finder and brute force compare the same expression.
void expect_brute_force_pairs(const std::vector<Sphere>& spheres, double extra) {
    const ParticleState particles = state_of(spheres);
    CandidateFinder finder;
    PairList list;
    for (const double scale : {1.0, 1.0625}) {
        finder.find(particles, scale, extra, kernels_for(""), list);
        const Pairs expected = brute_force_pairs(particles, scale, extra);
        EXPECT_EQ(pairs_of(list), expected) << "scale " << scale << ", extra " << extra;
        EXPECT_EQ(list.i.size(), (list.count + 63U) / 64U * 64U);
        EXPECT_EQ(list.i.size(), list.j.size());
    }
}

class Candidates : public ::testing::TestWithParam<double> {};

TEST_P(Candidates, AreThePairsOfBruteForce) {
    const double ratio = GetParam();
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const auto spheres = random_cloud(400, ratio, 0.01 * std::cbrt(ratio), seed);
        ASSERT_GT(brute_force_pairs(state_of(spheres), 1.0, 0.0).size(), 50U);
        for (const double extra : {0.0, 0.0005, 0.005}) {
            expect_brute_force_pairs(spheres, extra);
        }
    }
}

TEST_P(Candidates, AreThePairsOfBruteForceInClusters) {
    std::vector<Sphere> spheres;
    for (const Vec3& centre : {Vec3{0.0, 0.0, 0.0}, Vec3{1.0, 0.0, 0.0}, Vec3{-3.0, 7.0, 0.1}}) {
        for (Sphere sphere : random_cloud(100, GetParam(), 0.004, 7)) {
            sphere.position += centre;
            spheres.push_back(sphere);
        }
    }
    expect_brute_force_pairs(spheres, 0.0005);
}

INSTANTIATE_TEST_SUITE_P(SizeRatios, Candidates, ::testing::Values(1.0, 3.0, 20.0));

TEST(Candidates, AreFoundDespiteAParticleThatStrayedFarAway) {
    auto spheres = random_cloud(400, 3.0, 0.015, 3);
    spheres[200].position = {1e4, -1e4, 1e4};
    expect_brute_force_pairs(spheres, 0.0005);
}

TEST(Candidates, AreFoundInAPlaneAndOnALine) {
    auto spheres = random_cloud(300, 3.0, 0.03, 4);
    for (Sphere& sphere : spheres) {
        sphere.position.z = 0.25;
    }
    expect_brute_force_pairs(spheres, 0.0005);
    for (Sphere& sphere : spheres) {
        sphere.position.x *= 20.0;
        sphere.position.y = -1.0;
    }
    expect_brute_force_pairs(spheres, 0.0005);
}

/// The passes read whole words of pairs. A shorter list must not leave particles behind that a
/// longer one named: they may be gone by then.
TEST(PairList, NamesNobodyBehindItsEnd) {
    PairList pairs;
    for (Index k = 0; k < 200; ++k) {
        pairs.append(1000 + k, 2000 + k);
    }
    pairs.pad();
    pairs.count = 70;
    pairs.pad();
    ASSERT_EQ(pairs.i.size(), 128U);
    ASSERT_EQ(pairs.j.size(), 128U);
    for (std::size_t k = 70; k < 128; ++k) {
        EXPECT_EQ(pairs.i[k], 0U) << k;
        EXPECT_EQ(pairs.j[k], 0U) << k;
    }
}

TEST(Candidates, AreNoneForFewerThanTwoParticles) {
    CandidateFinder finder;
    PairList list;
    list.append(3, 4);
    for (const int count : {0, 1}) {
        finder.find(state_of(random_cloud(count, 1.0, 1.0, 1)), 1.0, 0.0, kernels_for(""), list);
        EXPECT_EQ(list.count, 0U);
    }
}

/// Random walks of all particles on top of a common drift, which the clock is told as its frame.
class Walk {
public:
    explicit Walk(std::uint64_t seed)
        : particles(state_of(random_cloud(50, 3.0, 0.02, seed))), random_(seed) {}

    /// Returns the largest step relative to the drift.
    double step() {
        double largest = 0.0;
        const Vec3 drift = in_cube(random_, 1e-4);
        frame += drift;
        for (Index slot = 0; slot < particles.size(); ++slot) {
            const Vec3 own = in_cube(random_, 2e-5);
            largest = std::max(largest, norm(own));
            shift(particles, slot, drift + own);
        }
        return largest;
    }

    /// Largest travel since `from`, relative to the frame; by radius over the smallest if asked.
    double largest_travel(const ParticleState& from, const Vec3& frame_then, bool by_radius) const {
        double largest = 0.0;
        for (Index slot = 0; slot < particles.size(); ++slot) {
            const Vec3 way = particles.position(slot) - from.position(slot) - (frame - frame_then);
            const double scale =
                by_radius ? particles.smallest_radius() / particles.radius(slot) : 1.0;
            largest = std::max(largest, scale * norm(way));
        }
        return largest;
    }

    ParticleState particles;
    Vec3 frame{};

private:
    std::mt19937_64 random_;
};

void expect_never_stale(bool by_radius, bool exact) {
    constexpr double limit = 2e-4;
    Walk walk(11);
    TravelClock clock(by_radius);
    clock.restart(walk.particles, walk.frame);
    ParticleState reference = walk.particles;
    Vec3 frame = walk.frame;
    int restarts = 0;
    for (int n = 0; n < 5000; ++n) {
        clock.add(walk.step());
        if (clock.expired(limit, walk.particles, walk.frame, exact, kernels_for(""))) {
            clock.restart(walk.particles, walk.frame);
            reference = walk.particles;
            frame = walk.frame;
            ++restarts;
        }
        // A few roundings of positions of about 0.1 m.
        ASSERT_LE(walk.largest_travel(reference, frame, by_radius), limit + 1e-16) << "step " << n;
    }
    EXPECT_GT(restarts, 20);
    EXPECT_LT(restarts, 5000 / 5);
}

TEST(TravelClock, ExpiresBeforeAnyParticleHasMovedTooFar) {
    expect_never_stale(false, true);
}

TEST(TravelClock, ExpiresBeforeAnyParticleHasMovedTooFarForItsSize) {
    expect_never_stale(true, true);
}

TEST(TravelClock, ExpiresInTimeByItsBoundAlone) {
    expect_never_stale(true, false);
}

TEST(TravelClock, NeverExpiresWhileAllMoveWithTheFrame) {
    ParticleState particles = state_of(random_cloud(20, 3.0, 0.02, 5));
    TravelClock clock;
    clock.restart(particles, {});
    const Vec3 step{1e-3, -2e-3, 5e-4};
    Vec3 frame{};
    for (int n = 0; n < 100; ++n) {
        frame += step;
        for (Index slot = 0; slot < particles.size(); ++slot) {
            shift(particles, slot, step);
        }
        clock.add(norm(step));
        ASSERT_FALSE(clock.expired(1e-6, particles, frame, true, kernels_for(""))) << "step " << n;
    }
    clock.add(norm(step));
    EXPECT_TRUE(clock.expired(1e-6, particles, {}, true, kernels_for("")))
        << "relative to a frame at rest";
}

TEST(ParticleState, KeepsWhatWasInsertedUnderItsId) {
    auto spheres = random_cloud(100, 3.0, 0.02, 6);
    for (std::size_t n = 0; n < spheres.size(); ++n) {
        spheres[n].velocity = {static_cast<double>(n), 0.0, 1.0};
        spheres[n].angular_velocity = {0.0, static_cast<double>(n), 2.0};
    }
    const ParticleState particles = state_of(spheres);
    ASSERT_EQ(particles.size(), 100U);
    for (std::size_t n = 0; n < spheres.size(); ++n) {
        const Index slot = particles.slots_by_id()[n];
        const double r = spheres[n].radius;
        const double mass = 1500.0 * 4.0 / 3.0 * pi * r * r * r;
        EXPECT_EQ(particles.id(slot), static_cast<std::int64_t>(n) + 1);
        EXPECT_EQ(particles.position(slot), spheres[n].position);
        EXPECT_EQ(particles.velocity(slot), spheres[n].velocity);
        EXPECT_EQ(particles.spin(slot), spheres[n].angular_velocity);
        EXPECT_EQ(particles.radius(slot), r);
        EXPECT_DOUBLE_EQ(particles.mass(slot), mass);
        EXPECT_DOUBLE_EQ(particles.inverse_mass(slot), 1.0 / mass);
        EXPECT_DOUBLE_EQ(particles.inverse_inertia(slot), 2.5 / (mass * r * r));
    }
}

TEST(ParticleState, MovesAndFindsTheFastestOfSeveralDirections) {
    ParticleState particles = state_of(random_cloud(3, 1.0, 0.02, 1));
    particles.set_velocity(0, {3.0, 0.0, 0.0});
    particles.set_velocity(1, {0.0, -4.0, 0.0});
    particles.set_velocity(2, {1.0, 2.0, 2.0});
    MotionPass pass{.particles = particles.view(),
                    .gravity = {},
                    .frame = {1.0, -1.0, 0.0, 0.0},
                    .kick = 0.1,
                    .drift = 0.1,
                    .local_damping = 0.0,
                    .few_are_loaded = false,
                    .first = 0,
                    .last = particles.size(),
                    .fastest_square = 0.0,
                    .velocity_sum = {}};
    kernels_for("").move(pass);
    EXPECT_EQ(pass.fastest_square, 13.0);  // of {0, 3, 2}; by axis it would be 4 + 9 + 4
}

/// Rows past the last particle once fell with gravity and ruled the fastest speed.
TEST(ParticleState, PadsItsColumnsWithRowsThatNeverMoveOrCount) {
    for (int count = 1; count < 10; ++count) {
        ParticleState particles = state_of(random_cloud(count, 1.0, 0.02, 1));
        const ParticleView view = particles.view();
        EXPECT_EQ(view.count, static_cast<std::size_t>(count));
        EXPECT_EQ(view.padded_count % 8, 0U);
        MotionPass pass{.particles = view,
                        .gravity = {0.0, 0.0, -10.0, 0.0},
                        .frame = {0.0, 0.0, -0.5, 0.0},
                        .kick = 0.1,
                        .drift = 0.1,
                        .local_damping = 0.0,
                        .few_are_loaded = false,
                        .first = 0,
                        .last = view.count,
                        .fastest_square = 0.0,
                        .velocity_sum = {}};
        kernels_for("").move(pass);
        EXPECT_DOUBLE_EQ(pass.velocity_sum[2], -1.0 * count);
        EXPECT_DOUBLE_EQ(pass.fastest_square, 0.25);
        for (std::size_t k = 4 * view.count; k < 4 * view.padded_count; ++k) {
            EXPECT_EQ(view.position[k], 0.0);
            EXPECT_EQ(view.velocity[k], 0.0);
            EXPECT_EQ(view.spin[k], 0.0);
        }
        for (std::size_t k = load_row * view.count; k < load_row * view.padded_count; ++k) {
            EXPECT_EQ(view.loads[k], 0.0);
        }
    }
}

TEST(ParticleState, KeepsMomentumWhereInertiaIsScaled) {
    auto spheres = random_cloud(3, 3.0, 0.02, 6);
    spheres[1].velocity = {1.0, -2.0, 3.0};
    ParticleState particles = state_of(spheres);
    const Index slot = particles.slots_by_id()[1];
    const Vec3 momentum = (1.0 / particles.inverse_mass(slot)) * particles.velocity(slot);
    const double mass = particles.mass(slot);
    particles.scale_inertia(slot, 100.0);
    EXPECT_DOUBLE_EQ(particles.inverse_mass(slot), 1.0 / (100.0 * mass));
    EXPECT_EQ(particles.mass(slot), mass);
    const Vec3 now = (1.0 / particles.inverse_mass(slot)) * particles.velocity(slot);
    EXPECT_DOUBLE_EQ(now.x, momentum.x);
    EXPECT_DOUBLE_EQ(now.y, momentum.y);
    EXPECT_DOUBLE_EQ(now.z, momentum.z);
}

/// Eight flags are read as one number, which only zeros and ones fit.
TEST(ParticleState, RefusesFlagsThatAreNeitherZeroNorOne) {
    ParticleState particles = state_of(random_cloud(3, 3.0, 0.02, 6));
    Archive archive;
    particles.save(archive);
    particles.load(archive);
    auto flags = archive.get<std::uint8_t>("particles/loaded");
    flags[1] = 2;
    archive.put("particles/loaded", flags);
    EXPECT_THROW(particles.load(archive), Error);
}

}  // namespace
}  // namespace grainbench
