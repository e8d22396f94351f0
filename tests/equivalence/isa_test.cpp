/// Every instruction set of this processor gives the bits of the one-lane passes, for every number
/// of contacts that can fill a block in part or whole.
#include "core/kernels/kernels.hpp"

#include "tests/equivalence/random_contacts.hpp"

#include <gtest/gtest.h>

#include <cstring>

namespace grainbench::test {
namespace {

constexpr Index particle_count = 17;
constexpr Index most_contacts = 40;

/// Bytes of columns, one after the other.
class Bytes {
public:
    template <class Container>
    Bytes& add(const Container& column) {
        return add(column.data(), column.size());
    }

    template <class T>
    Bytes& add(const T* values, std::size_t count) {
        const auto* first = reinterpret_cast<const unsigned char*>(values);
        bytes_.insert(bytes_.end(), first, first + count * sizeof(T));
        return *this;
    }

    friend bool operator==(const Bytes&, const Bytes&) = default;

private:
    std::vector<unsigned char> bytes_;
};

/// Calls check(isa, kernels) for all sets but scalar. At least one other must exist: every
/// processor that can run this program in 64 bits has sse4, or there is nothing to compare.
template <class Check>
void for_each_set(Check&& check) {
    if (available_isa(1).empty()) {
        GTEST_SKIP() << "this processor has the scalar passes only";
    }
    for (std::size_t n = 1; !available_isa(n).empty(); ++n) {
        check(available_isa(n), kernels_for(available_isa(n)));
    }
}

Bytes moved(const Kernels& kernels, Index count, std::uint64_t seed) {
    RandomParticles p(count, seed);
    MotionPass pass{.particles = p.view(),
                    .gravity = {0.1, -0.3, -9.8, 0.0, 0.1, -0.3, -9.8, 0.0},
                    .frame = {0.5, -0.2, 0.7, 0.0, 0.5, -0.2, 0.7, 0.0},
                    .kick = 1.1e-5,
                    .drift = 1.3e-5,
                    .fastest = {},
                    .velocity_sum = {}};
    kernels.move(pass);
    return Bytes()
        .add(p.position)
        .add(p.velocity)
        .add(p.spin)
        .add(p.force)
        .add(p.torque)
        .add(pass.fastest, 4)
        .add(pass.velocity_sum, 4);
}

TEST(InstructionSets, MoveAlike) {
    for_each_set([](std::string_view isa, const Kernels& kernels) {
        for (Index n = 2; n <= most_contacts; ++n) {
            EXPECT_TRUE(moved(kernels, n, n) == moved(kernels_for("scalar"), n, n))
                << isa << " " << n;
        }
    });
}

std::vector<Index> pairs_found(const Kernels& kernels, Index count, std::uint64_t seed) {
    const RandomParticles p(particle_count, seed);
    const RandomPairs pairs(particle_count, 0, seed);
    std::vector<Index> found(count + 8);
    found.resize(kernels.find_pairs({.position = p.position.data(),
                                     .i = pairs.i.data(),
                                     .j = pairs.j.data(),
                                     .count = count,
                                     .scale = 0.4,
                                     .extra = 0.001,
                                     .found = found.data()}));
    return found;
}

TEST(InstructionSets, FindTheSamePairs) {
    for_each_set([](std::string_view isa, const Kernels& kernels) {
        for (Index n = 0; n <= most_contacts; ++n) {
            EXPECT_EQ(pairs_found(kernels, n, n), pairs_found(kernels_for("scalar"), n, n))
                << isa << " " << n;
        }
    });
    const auto found = pairs_found(kernels_for("scalar"), most_contacts, most_contacts);
    EXPECT_GT(found.size(), 5U);
    EXPECT_LT(found.size(), most_contacts - 5U);
}

std::vector<Index> patches_found(const Kernels& kernels, Index count, bool rotated) {
    const RandomParticles p(particle_count, count);
    std::mt19937_64 random(count);
    Column<double> planes;
    for (int patch = 0; patch < 5; ++patch) {
        const Vec3 normal = normalized(
            {between(random, -1.0, 1.0), between(random, -1.0, 1.0), between(random, -1.0, 1.0)});
        planes.insert(planes.end(), {normal.x, normal.y, normal.z, between(random, -0.01, 0.01)});
    }
    Column<Index> particle(count + 16, 0);
    Column<Index> patch(count + 16, 0);
    for (Index k = 0; k < count; ++k) {
        particle[k] = static_cast<Index>(random() % particle_count);
        patch[k] = static_cast<Index>(random() % 5);
    }
    std::vector<Index> found(count + 8);
    found.resize(kernels.find_patches({.position = p.position.data(),
                                       .planes = planes.data(),
                                       .particle = particle.data(),
                                       .patch = patch.data(),
                                       .count = count,
                                       .shift = {0.001, -0.0002, 0.0005},
                                       .rotation = {0.6, 0.8, 0.0, -0.8, 0.6, 0.0, 0.0, 0.0, 1.0},
                                       .centre = {0.01, 0.0, -0.02},
                                       .rotated = rotated,
                                       .scale = 1.0,
                                       .extra = 0.0,
                                       .found = found.data()}));
    return found;
}

TEST(InstructionSets, FindTheSamePatches) {
    for_each_set([](std::string_view isa, const Kernels& kernels) {
        for (Index n = 0; n <= most_contacts; ++n) {
            for (const bool rotated : {false, true}) {
                EXPECT_EQ(patches_found(kernels, n, rotated),
                          patches_found(kernels_for("scalar"), n, rotated))
                    << isa << " " << n << (rotated ? " rotated" : "");
            }
        }
    });
    const auto found = patches_found(kernels_for("scalar"), most_contacts, false);
    EXPECT_GT(found.size(), 5U);
    EXPECT_LT(found.size(), most_contacts - 5U);
}

Bytes pair_forces(const Kernels& kernels, std::size_t combination, bool records, Index touching) {
    const std::uint64_t seed = 100 * combination + touching;
    RandomParticles p(particle_count, seed);
    RandomPairs pairs(particle_count, touching, seed);
    const ContactTable table = random_table(combination, seed);
    const std::size_t stride = pairs.i.size();
    std::mt19937_64 random(seed);
    Column<double> history(stride * static_cast<std::size_t>(table.history_size()));
    for (double& h : history) {
        h = between(random, -3.0, 10.0);
    }
    Column<double> record(static_cast<std::size_t>(touching) * record_size);
    kernels.pair_pass(combination,
                      records,
                      {.particles = p.view(),
                       .laws = table.view(1.7e-5),
                       .i = pairs.i.data(),
                       .j = pairs.j.data(),
                       .touching = pairs.touching.data(),
                       .touching_count = touching,
                       .active = pairs.active.data(),
                       .history = history.data(),
                       .history_stride = stride,
                       .records = record.data()});
    return Bytes().add(p.force).add(p.torque).add(pairs.active).add(history).add(record);
}

TEST(InstructionSets, GiveTheSameForcesBetweenParticles) {
    for_each_set([](std::string_view isa, const Kernels& kernels) {
        for (std::size_t c = 0; c < combination_count(); ++c) {
            for (const bool records : {false, true}) {
                for (Index n = 1; n <= most_contacts; ++n) {
                    EXPECT_TRUE(pair_forces(kernels, c, records, n) ==
                                pair_forces(kernels_for("scalar"), c, records, n))
                        << isa << ", laws " << c << ", " << n << " contacts";
                }
            }
        }
    });
}

Bytes wall_forces(const Kernels& kernels, std::size_t combination, bool records, Index count) {
    const std::uint64_t seed = 100 * combination + count;
    RandomParticles p(particle_count, seed);
    const ContactTable table = random_table(combination, seed);
    std::mt19937_64 random(seed);
    const std::size_t stride = count + 5;
    const auto column = [&](std::size_t width, double low, double high) {
        Column<double> values(stride * width);
        for (double& value : values) {
            value = between(random, low, high);
        }
        return values;
    };
    std::vector<Index> particle(count);
    Column<double> normal = column(3, -1.0, 1.0);
    Column<double> entered = column(1, 0.0, 1.0);
    for (Index t = 0; t < count; ++t) {
        particle[t] = t * particle_count / (count + 1);  // ascending, some with several contacts
        const Vec3 n = normalized({normal[t], normal[stride + t], normal[2 * stride + t]});
        normal[t] = n.x;
        normal[stride + t] = n.y;
        normal[2 * stride + t] = n.z;
        entered[t] = entered[t] < 0.5 ? 0.0 : 1.0;
    }
    const Column<double> distance = column(1, 0.0025, 0.0055);
    const Column<double> velocity = column(3, -1.0, 1.0);
    const Column<double> spin = column(1, -10.0, 10.0);
    Column<double> history = column(static_cast<std::size_t>(table.history_size()), -3.0, 10.0);
    Column<double> force(3 * stride, 0.0);
    Column<double> record(static_cast<std::size_t>(count) * record_size);
    kernels.wall_pass(combination,
                      records,
                      {.particles = p.view(),
                       .laws = table.view(1.7e-5),
                       .count = count,
                       .stride = stride,
                       .particle = particle.data(),
                       .normal = normal.data(),
                       .distance = distance.data(),
                       .wall_velocity = velocity.data(),
                       .wall_spin = spin.data(),
                       .entered = entered.data(),
                       .material = 2.0,
                       .history_in = history.data(),
                       .history_out = history.data(),
                       .force = force.data(),
                       .records = record.data()});
    return Bytes().add(p.force).add(p.torque).add(history).add(force).add(record);
}

TEST(InstructionSets, GiveTheSameForcesOnWalls) {
    for_each_set([](std::string_view isa, const Kernels& kernels) {
        for (std::size_t c = 0; c < combination_count(); ++c) {
            for (const bool records : {false, true}) {
                for (Index n = 1; n <= most_contacts; ++n) {
                    EXPECT_TRUE(wall_forces(kernels, c, records, n) ==
                                wall_forces(kernels_for("scalar"), c, records, n))
                        << isa << ", laws " << c << ", " << n << " contacts";
                }
            }
        }
    });
}

}  // namespace
}  // namespace grainbench::test
