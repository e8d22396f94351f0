/// The lists of contacts with a wall against all patches, while particles fly about.
#include "core/contact/wall_contacts.hpp"

#include "tests/unit/core/search_support.hpp"
#include "tests/unit/core/wall_support.hpp"

#include <gtest/gtest.h>

namespace grainbench {
namespace {

constexpr double timestep = 1e-4;
constexpr double half_edge = 0.06;
constexpr double speed = 1.0;

/// Spheres that fly on straight lines through the container of the example, from its middle, where
/// they are far from any patch, to beyond its sides and back.
/// \param looks_ahead whether look-aheads mark what is to be tested until the next one
void expect_no_contact_missed(const WallMotion& motion,
                              std::uint64_t seed,
                              bool looks_ahead = false,
                              double widest = 0.0) {
    std::mt19937_64 random(seed);
    ParticleState particles = state_of(random_cloud(40, 3.0, half_edge, seed));
    std::vector<Vec3> velocity;
    for (Index slot = 0; slot < particles.size(); ++slot) {
        velocity.push_back(in_cube(random, speed));
    }
    const Wall given{
        .name = "wall", .shape = example_container(), .motion = motion, .material = {}};
    WallBody wall(given, "/walls/0", 0);
    WallContacts contacts({.tolerance = 0.0625, .widest = widest, .slack = 0.0015}, 0);
    const double fastest = std::sqrt(3.0) * speed;
    std::size_t touching = 0;
    for (std::uint64_t cycle = 0; cycle < 1500; ++cycle) {
        const bool may_renew = !looks_ahead || contacts.look_ahead_is_due();
        const Renewal due = contacts.update(cycle, may_renew, particles, wall, kernels_for(""), {});
        if (looks_ahead && due != Renewal::none) {
            contacts.look_ahead(particles, wall, 0.0, kernels_for(""), {});
        }
        contacts.find_touching(particles, wall, 0.0, kernels_for(""), {});
        std::vector<std::size_t> found(particles.size(), 0);
        for (Index t = 0; t < contacts.touching_count(); ++t) {
            ++found[contacts.particle(t)];
        }
        for (Index slot = 0; slot < particles.size(); ++slot) {
            const Vec3 centre = wall.to_wall(particles.position(slot));
            const auto hits = hits_of(wall.surface(), centre, particles.radius(slot));
            ASSERT_EQ(found[slot], hits.size()) << "particle " << slot << ", cycle " << cycle;
            touching += hits.size();
        }
        wall.begin_step(timestep * static_cast<double>(cycle));
        for (Index slot = 0; slot < particles.size(); ++slot) {
            Vec3& v = velocity[slot];
            const Vec3 p = particles.position(slot);
            for (const auto& [x, along] : {std::pair{p.x, &v.x}, {p.y, &v.y}, {p.z, &v.z}}) {
                *along = std::abs(x) > half_edge ? -std::copysign(*along, x) : *along;
            }
            shift(particles, slot, timestep * v);
        }
        contacts.add_travel(wall.relative_speed_bound(fastest, {}) * timestep, 0.0);
        wall.move(timestep);
    }
    EXPECT_GT(touching, 1000U);
}

TEST(WallContacts, MissNoneOfAFixedWall) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        expect_no_contact_missed(FixedMotion{}, seed);
    }
}

TEST(WallContacts, MissNoneOfAWallThatSwings) {
    expect_no_contact_missed(SinusoidMotion{.velocity = {1.0, 0.0, 0.5}, .frequency = 10.0}, 4);
}

TEST(WallContacts, MissNoneOfAWallThatTurns) {
    expect_no_contact_missed(
        RotationMotion{.point = {0.0, 0.0, 0.0}, .axis = {1.0, 0.0, 0.0}, .rate = 20.0}, 5);
}

/// Lists that reach farther, of candidates that are kept until a particle has come far enough.
TEST(WallContacts, MissNoneWithCandidatesInReserve) {
    const SinusoidMotion swing{.velocity = {1.0, 0.0, 0.5}, .frequency = 10.0};
    const RotationMotion turn{.point = {0.0, 0.0, 0.0}, .axis = {1.0, 0.0, 0.0}, .rate = 20.0};
    for (const WallMotion& motion :
         {WallMotion{FixedMotion{}}, WallMotion{swing}, WallMotion{turn}}) {
        expect_no_contact_missed(motion, 6, false, 0.16);
    }
}

TEST(WallContacts, MissNoneBetweenLookAheads) {
    const SinusoidMotion swing{.velocity = {1.0, 0.0, 0.5}, .frequency = 10.0};
    const RotationMotion turn{.point = {0.0, 0.0, 0.0}, .axis = {1.0, 0.0, 0.0}, .rate = 20.0};
    for (const double widest : {0.0, 0.16}) {
        for (const WallMotion& motion :
             {WallMotion{FixedMotion{}}, WallMotion{swing}, WallMotion{turn}}) {
            expect_no_contact_missed(motion, 7, true, widest);
        }
    }
}

/// Lists are made for what a particle is now, not for what had its slot before.
TEST(WallContacts, ForgetWhereParticlesWereWhoseSlotsOthersHave) {
    Sphere far;
    far.radius = 0.001;
    Sphere near = far;
    near.position = {0.0, 0.0, -0.0991};
    ParticleState particles = state_of({far, near});
    const Wall given{.name = "wall",
                     .shape = BoxShape{{-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}},
                     .motion = FixedMotion{},
                     .material = {}};
    const WallBody wall(given, "/walls/0", 0);
    WallContacts contacts({.tolerance = 0.0625, .slack = 0.0015}, 0);
    contacts.update(0, true, particles, wall, kernels_for(""), {});
    contacts.find_touching(particles, wall, 0.0, kernels_for(""), {});
    ASSERT_EQ(contacts.touching_count(), 1U);
    Scene scene;
    scene.particles.species = {{"ball", 0.001, 1500.0}};
    scene.contact.stiffness = ConstantStiffness::Params{.normal = 1000.0, .shear = 0.0};
    const ContactTable table(scene.contact, Materials(scene));
    contacts.add_forces(particles, wall, table, timestep, Records::none, kernels_for(""), {});
    const Index leaving = 1 - contacts.particle(0);
    const PopulationChange change = particles.departure_of(std::span(&leaving, 1));
    particles.change_population(change);
    contacts.change_population(change, particles);
    contacts.update(1, true, particles, wall, kernels_for(""), {});
    contacts.find_touching(particles, wall, 0.0, kernels_for(""), {});
    EXPECT_EQ(contacts.touching_count(), 1U);
}

}  // namespace
}  // namespace grainbench
