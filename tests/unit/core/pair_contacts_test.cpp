/// The lists of contacts against brute force, while particles fly about.
#include "core/contact/pair_contacts.hpp"

#include "tests/unit/core/search_support.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace grainbench {
namespace {

constexpr double timestep = 1e-4;
constexpr double stiffness = 1000.0;
constexpr double half_edge = 0.012;

Scene springs_only() {
    Scene scene;
    scene.particles.species = {{"ball", 0.001, 1500.0}};
    scene.contact.stiffness = ConstantStiffness::Params{.normal = stiffness, .shear = 0.0};
    scene.contact.normal = IncrementalSpring::Params{};
    return scene;
}

/// Particles that fly on straight lines within a cube that itself drifts, and pass through each
/// other; beside them what the lists should say, from brute force.
class FlyingCloud {
public:
    FlyingCloud(const SearchSettings& settings,
                double speed,
                std::uint64_t seed,
                bool looks_ahead = false,
                double fall_speed = 0.0)
        : looks_ahead_(looks_ahead),
          fall_(fall_speed * timestep),
          random_(seed),
          particles_(state_of(random_cloud(150, 3.0, half_edge, seed))) {
        const Scene scene = springs_only();
        table_ = ContactTable(scene.contact, Materials(scene));
        contacts_ = PairContacts(settings, table_.history_size());
        for (Index slot = 0; slot < particles_.size(); ++slot) {
            own_velocity_.push_back(in_cube(random_, speed));
        }
        look(0);
    }

    /// Returns the number of pairs that touch by brute force and not by the lists, or the reverse.
    std::size_t step(std::uint64_t cycle) {
        double fastest = 0.0;
        for (Index slot = 0; slot < particles_.size(); ++slot) {
            Vec3& v = own_velocity_[slot];
            const Vec3 p = particles_.position(slot) - frame_;
            for (const auto& [x, speed] : {std::pair{p.x, &v.x}, {p.y, &v.y}, {p.z, &v.z}}) {
                *speed = std::abs(x) > half_edge ? -std::copysign(*speed, x) : *speed;
            }
            fastest = std::max(fastest, norm(v));
            particles_.set_velocity(slot, v + drift_);
            shift(particles_, slot, timestep * (v + drift_));
        }
        frame_ += timestep * drift_;
        bound_ = fastest * timestep;
        contacts_.add_travel(bound_, fall_);
        return look(cycle);
    }

    void speed_up(double factor) {
        for (Vec3& v : own_velocity_) {
            v = factor * v;
        }
    }

    const PairContacts& contacts() const { return contacts_; }

    std::uint64_t late() const { return late_; }

    std::size_t kept() const { return kept_; }

    std::size_t look_aheads() const { return look_aheads_; }

private:
    std::size_t look(std::uint64_t cycle) {
        const Pairs known_before = pairs_of(contacts_.objects());
        const Kernels& kernels = kernels_for("");
        const bool may_renew = !looks_ahead_ || contacts_.look_ahead_is_due();
        const Renewal due = contacts_.due(cycle, may_renew, particles_, frame_, kernels);
        contacts_.renew(due, cycle, particles_, frame_, kernels);
        const bool looks_ahead = looks_ahead_ && due != Renewal::none;
        contacts_.find_touching(particles_, 0.0, looks_ahead, kernels);
        if (looks_ahead) {
            ++look_aheads_;
            expect_counts();
        }
        contacts_.add_forces(particles_, table_, timestep, Records::all, kernels);
        const Pairs touching = touching_pairs();
        const Pairs expected = brute_force_pairs(particles_, 1.0, 0.0);
        const std::set known(known_before.begin(), known_before.end());
        expect_forces(touching, known, cycle);
        Pairs different;
        std::set_symmetric_difference(touching.begin(),
                                      touching.end(),
                                      expected.begin(),
                                      expected.end(),
                                      std::back_inserter(different));
        return different.size();
    }

    /// What counts for the stable step, from the sums of normal stiffness of each particle, against
    /// all pairs that touch or may touch within two and a half steps of the fastest, or of a fall.
    void expect_counts() {
        Column<double> shear(particles_.positions().size());
        Column<double> normal(shear.size());
        contacts_.add_steps(
            particles_, table_, false, {shear.data(), normal.data(), 0.0, 0.0}, kernels_for(""));
        std::vector<int> expected(particles_.size());
        const double horizon = std::max(2.5 * std::max(bound_, bound_ > 0.0 ? fall_ : 0.0),
                                        1e-3 * particles_.smallest_radius());
        for (const auto& [i, j] : brute_force_pairs(particles_, 1.0, 2.0 * horizon)) {
            ++expected[i];
            ++expected[j];
        }
        for (Index slot = 0; slot < particles_.size(); ++slot) {
            const double* sum = normal.data() + 4 * std::size_t{slot};
            // Sums of squares of unit vectors, to a rounding each.
            EXPECT_NEAR((sum[0] + sum[1] + sum[2]) / stiffness, expected[slot], 1e-12);
        }
    }

    Pairs touching_pairs() const {
        Pairs pairs;
        for (const TouchingContact contact : contacts_.touching()) {
            pairs.emplace_back(contacts_.objects().i[contact.place()],
                               contacts_.objects().j[contact.place()]);
        }
        return pairs;
    }

    /// Sums the spring force of every pair beside the contacts. It equals theirs only if they carry
    /// the history of a pair from list to list and forget it when the pair opens.
    void expect_forces(const Pairs& touching,
                       const std::set<std::pair<Index, Index>>& known,
                       std::uint64_t cycle) {
        std::map<std::pair<Index, Index>, double> next;
        for (Index t = 0; t < touching.size(); ++t) {
            const auto [i, j] = touching[t];
            const auto before = force_.find(touching[t]);
            const bool stays = before != force_.end();
            const bool found_late = !stays && !known.contains(touching[t]);
            late_ += found_late && cycle > 0 ? 1 : 0;
            kept_ += stays ? 1 : 0;
            const Vec3 apart = particles_.position(j) - particles_.position(i);
            const Vec3 normal = normalized(apart);
            const double overlap = particles_.radius(i) + particles_.radius(j) - norm(apart);
            const double opening =
                timestep * dot(particles_.velocity(j) - particles_.velocity(i), normal);
            const double way = stays || found_late
                                   ? opening
                                   : std::copysign(std::min(std::abs(opening), overlap), opening);
            const double force = std::max(0.0, (stays ? before->second : 0.0) - stiffness * way);
            next[touching[t]] = force;
            // A hundred steps of a few roundings each of forces of about 1 N.
            EXPECT_NEAR(contacts_.record(t)[record_normal], force, 1e-13)
                << "pair " << i << " " << j << " cycle " << cycle;
        }
        force_ = std::move(next);
    }

    bool looks_ahead_;
    double fall_;  ///< [m] of a step, for the look-ahead
    std::mt19937_64 random_;
    ParticleState particles_;
    ContactTable table_;
    PairContacts contacts_;
    std::vector<Vec3> own_velocity_;
    Vec3 drift_{0.3, -0.2, 1.0};
    Vec3 frame_{};
    std::map<std::pair<Index, Index>, double> force_;
    std::uint64_t late_ = 0;
    std::size_t kept_ = 0;
    std::size_t look_aheads_ = 0;
    double bound_ = 0.0;  ///< [m] of the way of any particle in the last step
};

TEST(PairContacts, MissNoTouchingPairWithTheDisplacementTrigger) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        FlyingCloud cloud({.tolerance = 0.0625, .slack = 0.00025}, 0.1, seed);
        for (std::uint64_t cycle = 1; cycle <= 1000; ++cycle) {
            ASSERT_EQ(cloud.step(cycle), 0U) << "cycle " << cycle;
        }
        EXPECT_EQ(cloud.contacts().late_count(), cloud.late());
        EXPECT_GT(cloud.kept(), 10000U);
        // The lists did their work: most steps renewed none of them.
        EXPECT_GT(cloud.contacts().renewals(), 100U);
        EXPECT_LT(cloud.contacts().renewals(), 500U);
        EXPECT_GT(cloud.contacts().candidate_builds(), 10U);
        EXPECT_LT(cloud.contacts().candidate_builds(), cloud.contacts().renewals());
    }
}

/// Contact objects reach so far that few of them are in doubt: these alone are tested from
/// look-ahead to look-ahead.
TEST(PairContacts, MissNoTouchingPairBetweenLookAheads) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        FlyingCloud cloud({.tolerance = 2.0, .slack = 0.00025}, 0.1, seed, true);
        for (std::uint64_t cycle = 1; cycle <= 1000; ++cycle) {
            ASSERT_EQ(cloud.step(cycle), 0U) << "cycle " << cycle;
        }
        EXPECT_GT(cloud.look_aheads(), 300U);
        EXPECT_LT(cloud.look_aheads(), 600U);
        EXPECT_LT(cloud.contacts().renewals(), 100U);
    }
}

/// Lists that are kept from look-ahead to look-ahead are renewed before one could miss a pair.
TEST(PairContacts, CountAllThatMayTouchSoonThoughListsAreKept) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        FlyingCloud cloud({.tolerance = 0.2, .slack = 0.00025}, 0.1, seed, true);
        for (std::uint64_t cycle = 1; cycle <= 1000; ++cycle) {
            ASSERT_EQ(cloud.step(cycle), 0U) << "cycle " << cycle;
        }
        EXPECT_GT(cloud.look_aheads(), 300U);
        EXPECT_LT(cloud.look_aheads(), 400U);  // every third step, with new lists or without
        EXPECT_GT(cloud.contacts().renewals(), 50U);
    }
}

/// Where a list would last for a few steps alone it reaches farther, and no pair is missed.
TEST(PairContacts, ReachFartherWhereParticlesAreFast) {
    const auto renewals = [](double speed, double widest) {
        FlyingCloud cloud({.tolerance = 0.0625, .widest = widest, .slack = 0.00025}, speed, 1);
        for (std::uint64_t cycle = 1; cycle <= 500; ++cycle) {
            EXPECT_EQ(cloud.step(cycle), 0U) << "cycle " << cycle;
        }
        return cloud.contacts().renewals();
    };
    EXPECT_LT(2 * renewals(0.1, 0.16), renewals(0.1, 0.0));
    // 40 steps of the slow ones are less than the tolerance.
    EXPECT_EQ(renewals(0.005, 0.16), renewals(0.005, 0.0));
}

/// Candidates that were found while all were slow hold no more than they reach, however fast
/// particles have become.
TEST(PairContacts, ReachNoFartherThanTheirCandidates) {
    for (std::uint64_t slow_cycles = 300; slow_cycles <= 400; slow_cycles += 20) {
        FlyingCloud cloud({.tolerance = 0.0625, .widest = 0.5, .slack = 0.00025}, 0.005, 2);
        for (std::uint64_t cycle = 1; cycle <= slow_cycles + 50; ++cycle) {
            ASSERT_EQ(cloud.step(cycle), 0U) << "cycle " << cycle;
            if (cycle == slow_cycles) {
                cloud.speed_up(20.0);
            }
        }
    }
}

/// Where all are slower than what has fallen a little, look-aheads last as if one were as fast.
TEST(PairContacts, LookAsFarAheadAsAFall) {
    FlyingCloud cloud({.tolerance = 2.0, .slack = 0.00025}, 0.1, 1, true, 0.5);
    for (std::uint64_t cycle = 1; cycle <= 1000; ++cycle) {
        ASSERT_EQ(cloud.step(cycle), 0U) << "cycle " << cycle;
    }
    EXPECT_GT(cloud.look_aheads(), 60U);
    EXPECT_LT(cloud.look_aheads(), 200U);
}

TEST(PairContacts, FindLateContactsAtTheNextSearchAndCountThem) {
    FlyingCloud cloud({.tolerance = 0.0625, .slack = 0.00025, .interval = 20}, 0.2, 4);
    std::size_t missed = 0;
    for (std::uint64_t cycle = 1; cycle <= 1000; ++cycle) {
        const std::size_t different = cloud.step(cycle);
        missed += different;
        if (cycle % 20 == 0) {
            ASSERT_EQ(different, 0U) << "cycle " << cycle;
        }
    }
    EXPECT_GT(missed, 100U);
    EXPECT_GT(cloud.late(), 10U);
    EXPECT_EQ(cloud.contacts().late_count(), cloud.late());
    EXPECT_EQ(cloud.contacts().renewals(), 1U + 1000U / 20U);
}

TEST(PairContacts, KeepEveryPairWithBruteForce) {
    FlyingCloud cloud({.tolerance = 0.0625, .brute_force = true}, 0.2, 5);
    for (std::uint64_t cycle = 1; cycle <= 100; ++cycle) {
        ASSERT_EQ(cloud.step(cycle), 0U) << "cycle " << cycle;
    }
    EXPECT_EQ(cloud.contacts().objects().count, 150U * 149U / 2U);
    EXPECT_EQ(cloud.contacts().renewals(), 1U);
}

}  // namespace
}  // namespace grainbench
