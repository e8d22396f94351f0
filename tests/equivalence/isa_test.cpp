/// Every instruction set of this processor gives the bits of the one-lane passes, for every number
/// of contacts that can fill a block in part or whole; and the general pass gives those of the
/// passes that have their laws compiled in.
#include "core/contact/bits.hpp"
#include "core/contact/contact_records.hpp"
#include "core/kernels/kernels.hpp"
#include "core/walls/surface.hpp"

#include "tests/equivalence/random_contacts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <random>

namespace grainbench::test {
namespace {

constexpr Index particle_count = 17;
constexpr Index most_contacts = 40;

/// Flags of loaded particles are taken 64 at a time.
constexpr Index most_particles = 140;

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

using MovePass = void (*Kernels::*)(MotionPass&);

/// After a move of particles of which every third is loaded.
/// \param few whether the pass is told so
/// \param turns whether loads have torques
Bytes moved(const Kernels& kernels,
            Index count,
            bool few,
            MovePass move = &Kernels::move,
            bool turns = true) {
    RandomParticles p(count, count);
    for (Index n = 0; n < count; ++n) {
        if (n % 3 != 0) {
            std::fill_n(&p.loads[load_row * n + force_packet], 3, 0.0);
            p.loaded[n] = 0;
        }
        if (n % 3 != 0 || !turns) {
            std::fill_n(&p.loads[load_row * n + torque_packet], 3, 0.0);
        }
    }
    MotionPass pass{.particles = p.view(),
                    .gravity = {0.1, -0.3, -9.8, 0.0},
                    .frame = {0.5, -0.2, 0.7, 0.0},
                    .kick = 1.1e-5,
                    .drift = 1.3e-5,
                    .local_damping = 0.3,
                    .few_are_loaded = few,
                    .first = 0,
                    .last = count,
                    .fastest_square = 0.0,
                    .velocity_sum = {}};
    (kernels.*move)(pass);
    return Bytes()
        .add(p.position)
        .add(p.velocity)
        .add(p.spin)
        .add(p.loads)
        .add(p.loaded)
        .add(&pass.fastest_square, 1)
        .add(pass.velocity_sum, 3);
}

TEST(InstructionSets, MoveAlike) {
    for_each_set([](std::string_view isa, const Kernels& kernels) {
        const Kernels& scalar = kernels_for("scalar");
        for (Index n = 1; n <= most_particles; ++n) {
            for (const bool few : {false, true}) {
                EXPECT_TRUE(moved(kernels, n, few) == moved(scalar, n, few)) << isa << " " << n;
            }
            EXPECT_TRUE(moved(kernels, n, false, &Kernels::move_damped) ==
                        moved(scalar, n, false, &Kernels::move_damped))
                << isa << " " << n << ", damped";
        }
    });
}

/// Where nothing exerts torques, leaving rotation out changes no bit.
TEST(InstructionSets, MoveStraightAsWithoutTorques) {
    for_each_set([](std::string_view isa, const Kernels& kernels) {
        for (Index n = 1; n <= most_particles; ++n) {
            for (const bool few : {false, true}) {
                EXPECT_TRUE(moved(kernels, n, few, &Kernels::move_straight, false) ==
                            moved(kernels, n, few, &Kernels::move, false))
                    << isa << " " << n;
            }
        }
    });
}

/// Looking for the loaded particles first, or at all of them, is a matter of speed alone.
TEST(InstructionSets, MoveFewLoadedParticlesAsAll) {
    for (Index n = 1; n <= most_particles; ++n) {
        EXPECT_TRUE(moved(kernels_for(""), n, true) == moved(kernels_for(""), n, false)) << n;
    }
}

double travel(const Kernels& kernels, Index count, bool by_radius) {
    const RandomParticles then(count, count);
    const RandomParticles now(count, count + 1);
    TravelPass pass{.position = now.position.data(),
                    .reference = then.position.data(),
                    .padded_count = now.loaded.size(),
                    .frame = {0.001, -0.002, 0.0005},
                    .smallest_radius = 0.003,
                    .by_radius = by_radius,
                    .largest_square = 0.0};
    kernels.measure_travel(pass);
    return pass.largest_square;
}

TEST(InstructionSets, MeasureTheSameTravel) {
    for_each_set([](std::string_view isa, const Kernels& kernels) {
        for (Index n = 2; n <= most_contacts; ++n) {
            for (const bool by_radius : {false, true}) {
                EXPECT_EQ(travel(kernels, n, by_radius),
                          travel(kernels_for("scalar"), n, by_radius))
                    << isa << " " << n;
            }
        }
    });
    EXPECT_GT(travel(kernels_for("scalar"), 17, false), 0.0);
}

PairQuery random_query(const RandomParticles& p, const RandomPairs& pairs, Index count) {
    return {.position = p.position.data(),
            .i = pairs.i.data(),
            .j = pairs.j.data(),
            .count = count,
            .scale = 0.4,
            .extra = 0.001};
}

std::vector<Index> places_of(const std::vector<std::uint64_t>& words) {
    std::vector<Index> places;
    for_each_bit(words, [&](Index place) { places.push_back(place); });
    return places;
}

/// Pairs within reach, tested alone and beside what is in doubt.
std::vector<Index> pairs_tested(const Kernels& kernels, Index count, std::uint64_t seed) {
    const RandomParticles p(particle_count, seed);
    const RandomPairs pairs(particle_count, 0, seed);
    const PairQuery query = random_query(p, pairs, count);
    std::vector<std::uint64_t> within((count + 63) / 64);
    std::vector<std::uint64_t> beside(within.size());
    std::vector<std::uint64_t> doubtful(within.size());
    kernels.test_pairs(query, within.data());
    constexpr double margin = 0.0005;  // less than any reach here
    kernels.test_pairs_and_doubt(query, margin, beside.data(), doubtful.data());
    EXPECT_EQ(within, beside);
    std::vector<std::uint64_t> farther(within.size());
    std::vector<std::uint64_t> nearer(within.size());
    PairQuery shifted = query;
    shifted.extra = query.extra + margin;
    kernels.test_pairs(shifted, farther.data());
    shifted.extra = query.extra - margin;
    kernels.test_pairs(shifted, nearer.data());
    for (std::size_t w = 0; w < within.size(); ++w) {
        EXPECT_EQ(doubtful[w], farther[w] & ~nearer[w]);
    }
    return places_of(within);
}

TEST(InstructionSets, FindTheSamePairs) {
    for_each_set([](std::string_view isa, const Kernels& kernels) {
        for (Index n = 0; n <= most_contacts; ++n) {
            EXPECT_EQ(pairs_tested(kernels, n, n), pairs_tested(kernels_for("scalar"), n, n))
                << isa << " " << n;
        }
    });
    const auto found = pairs_tested(kernels_for("scalar"), most_contacts, most_contacts);
    EXPECT_GT(found.size(), 5U);
    EXPECT_LT(found.size(), most_contacts - 5U);
}

/// Words with every number of bits; nothing is written past the last pair.
TEST(InstructionSets, SelectTheSamePairs) {
    for_each_set([](std::string_view isa, const Kernels& kernels) {
        const RandomPairs pairs(particle_count, 0, 2);
        std::mt19937_64 random(2);
        for (int bits = 0; bits <= 64; ++bits) {
            std::uint64_t words[2] = {};
            for (int n = 0; n < bits; ++n) {
                words[0] |= std::uint64_t{1} << (random() % 64);
                words[1] |= std::uint64_t{1} << n;
            }
            std::vector<Index> expected;
            for_each_bit(words, [&](Index place) { expected.push_back(place); });
            EXPECT_EQ(kernels.count_bits(words, 2), expected.size()) << isa;
            for (const bool with_places : {false, true}) {
                // So long that a sanitizer sees their ends.
                std::vector<Index> place(expected.size());
                std::vector<Index> i(expected.size());
                std::vector<Index> j(expected.size());
                kernels.select_pairs({.bits = words,
                                      .words = 2,
                                      .first = 0,
                                      .i = pairs.i.data(),
                                      .j = pairs.j.data(),
                                      .place = with_places ? place.data() : nullptr,
                                      .chosen_i = i.data(),
                                      .chosen_j = j.data()});
                for (std::size_t k = 0; k < expected.size(); ++k) {
                    EXPECT_EQ(place[k], with_places ? expected[k] : 0) << isa << " " << bits;
                    EXPECT_EQ(i[k], pairs.i[expected[k]]) << isa << " " << bits;
                    EXPECT_EQ(j[k], pairs.j[expected[k]]) << isa << " " << bits;
                }
            }
        }
    });
}

/// The contacts of words with every number of bits, of which some are new; nothing is written past
/// the last.
TEST(InstructionSets, ListTheSameTouchingContacts) {
    for_each_set([](std::string_view isa, const Kernels& kernels) {
        std::mt19937_64 random(1);
        for (int bits = 0; bits <= 64; ++bits) {
            std::uint64_t now[2] = {};
            std::uint64_t before[2] = {random(), random()};
            for (int n = 0; n < bits; ++n) {
                now[0] |= std::uint64_t{1} << (random() % 64);
                now[1] |= std::uint64_t{1} << n;
            }
            std::vector<TouchingContact> expected;
            for_each_bit(now, [&](Index place) {
                expected.emplace_back(place + 128, !has_bit(before, place));
            });
            std::vector<TouchingContact> listed(
                expected.size());  // so that a sanitizer sees its end
            kernels.list_touching(now, before, 2, 128, listed.data());
            for (std::size_t t = 0; t < listed.size(); ++t) {
                EXPECT_EQ(listed[t].place(), expected[t].place()) << isa << " " << bits;
                EXPECT_EQ(listed[t].is_new(), expected[t].is_new()) << isa << " " << bits;
            }
        }
    });
}

struct PatchBits {
    std::uint64_t face, doubt;
    std::vector<double> height;

    friend bool operator==(const PatchBits&, const PatchBits&) = default;
};

PatchBits patches_tested(const Kernels& kernels, Index count, bool rotated) {
    const RandomParticles p(particle_count, count);
    std::mt19937_64 random(count);
    Column<double> planes;
    for (int plane = 0; plane < 4 * 5; ++plane) {
        const Vec3 normal = normalized(
            {between(random, -1.0, 1.0), between(random, -1.0, 1.0), between(random, -1.0, 1.0)});
        // The first of four is the plane of the patch, the others bound it.
        const double offset = between(random, -0.01, plane % 4 == 0 ? 0.01 : -0.002);
        planes.insert(planes.end(), {normal.x, normal.y, normal.z, offset});
    }
    Column<Index> particle(64, 0);
    Column<Index> patch(64, 0);
    for (Index k = 0; k < count; ++k) {
        particle[k] = static_cast<Index>(random() % particle_count);
        patch[k] = static_cast<Index>(random() % 5);
    }
    PatchBits bits{0, 0, std::vector<double>(64)};
    kernels.test_patches({.position = p.position.data(),
                          .planes = planes.data(),
                          .shells = nullptr,
                          .particle = particle.data(),
                          .patch = patch.data(),
                          .count = count,
                          .shift = {0.001, -0.0002, 0.0005},
                          .rotation = {0.6, 0.8, 0.0, -0.8, 0.6, 0.0, 0.0, 0.0, 1.0},
                          .rotated = rotated,
                          .scale = 1.0,
                          .extra = 0.0},
                         {&bits.face, &bits.doubt, bits.height.data()});
    bits.height.resize(count);
    return bits;
}

TEST(InstructionSets, TestPatchesAlike) {
    for_each_set([](std::string_view isa, const Kernels& kernels) {
        for (Index n = 1; n <= most_contacts; ++n) {
            for (const bool rotated : {false, true}) {
                EXPECT_TRUE(patches_tested(kernels, n, rotated) ==
                            patches_tested(kernels_for("scalar"), n, rotated))
                    << isa << " " << n << (rotated ? " rotated" : "");
            }
        }
    });
    const PatchBits bits = patches_tested(kernels_for("scalar"), most_contacts, false);
    EXPECT_GT(__builtin_popcountll(bits.face), 1);
    EXPECT_GT(__builtin_popcountll(bits.doubt), 1);
    EXPECT_EQ(bits.face & bits.doubt, 0U);
}

/// The side is the first patch. Spheres within and around an oblique cylinder; all near enough to
/// touch must stay in doubt, all farther from the endless cylinder than their radius must not.
TEST(InstructionSets, DoubtSidesOfCylindersWhereTheyMayTouchAlone) {
    const Cylinder cylinder{.base = {0.02, -0.01, 0.03},
                            .axis = normalized({1.0, 2.0, 3.0}),
                            .radius = 0.01,
                            .height = 0.03};
    const Surface surface(cylinder, "/walls/0");
    std::mt19937_64 random(7);
    RandomParticles p(64, 7);
    for (Index k = 0; k < 64; ++k) {
        p.position[4 * k] = cylinder.base.x + between(random, -0.016, 0.024);
        p.position[4 * k + 1] = cylinder.base.y + between(random, -0.016, 0.024);
        p.position[4 * k + 2] = cylinder.base.z + between(random, -0.016, 0.024);
    }
    Column<Index> particle(64);
    std::iota(particle.begin(), particle.end(), Index{0});
    const Column<Index> patch(64, 0);
    for_each_set([&](std::string_view isa, const Kernels& kernels) {
        std::uint64_t face = 0;
        std::uint64_t doubt = 0;
        std::vector<double> height(64);
        kernels.test_patches({.position = p.position.data(),
                              .planes = surface.planes().data(),
                              .shells = surface.shells().data(),
                              .particle = particle.data(),
                              .patch = patch.data(),
                              .count = 64,
                              .shift = {},
                              .rotation = {},
                              .rotated = false,
                              .scale = 1.0,
                              .extra = 0.0},
                             {&face, &doubt, height.data()});
        EXPECT_EQ(face, 0U) << isa;
        int near = 0;
        int far = 0;
        for (Index k = 0; k < 64; ++k) {
            const Vec3 centre{p.position[4 * k], p.position[4 * k + 1], p.position[4 * k + 2]};
            const double radius = p.position[4 * k + 3];
            const bool is_doubted = (doubt >> k & 1) != 0;
            std::vector<Index> touched;
            surface.collect(centre, radius, touched);
            const Vec3 from = centre - cylinder.base;
            const double across = norm(from - dot(cylinder.axis, from) * cylinder.axis);
            if (!touched.empty() && touched.front() == 0) {
                EXPECT_TRUE(is_doubted) << isa << " " << k;
                ++near;
            } else if (std::abs(across - cylinder.radius) > radius) {
                EXPECT_FALSE(is_doubted) << isa << " " << k;
                ++far;
            }
        }
        EXPECT_GT(near, 5);
        EXPECT_GT(far, 5);
    });
}

/// Rows of history, random where contacts act and zero where they are new.
Column<double> random_rows(std::size_t count, Index packets, std::mt19937_64& random) {
    Column<double> rows(count * packets * 4);
    for (double& h : rows) {
        h = between(random, -3.0, 10.0);
    }
    return rows;
}

std::uint64_t seed_of(const LawChoice& choice) {
    std::uint64_t seed = 1;
    for (const std::size_t law : choice) {
        seed = 7 * seed + law;
    }
    return 100 * seed;
}

/// Laws of a table for the pass that the engine would take, or for the general one.
LawView laws_of(const ContactTable& table, bool general) {
    LawView laws = table.view(1.7e-5);
    if (general) {
        laws.pass = general_pass;
    }
    return laws;
}

Bytes pair_forces(const Kernels& kernels,
                  const LawChoice& choice,
                  Records records,
                  Index touching,
                  bool general = false) {
    const std::uint64_t seed = seed_of(choice) + touching;
    RandomParticles p(particle_count, seed);
    RandomPairs pairs(particle_count, touching, seed);
    const ContactTable table = random_table(choice, seed);
    std::mt19937_64 random(seed);
    Column<double> rows =
        random_rows(pairs.i.size(), history_packets(table.history_size()), random);
    Column<double> record(static_cast<std::size_t>(touching) * record_size);
    Column<double> stored(touching);
    kernels.pair_pass({.particles = p.view(),
                       .laws = laws_of(table, general),
                       .i = pairs.i.data(),
                       .j = pairs.j.data(),
                       .touching = pairs.touching.data(),
                       .touching_count = touching,
                       .marks_loaded = true,
                       .rows = rows.data(),
                       .records = records == Records::all ? record.data() : nullptr,
                       .stored = records == Records::none ? nullptr : stored.data()});
    for (std::size_t t = 0; records == Records::all && t < stored.size(); ++t) {
        EXPECT_EQ(stored[t], record[t * record_size + record_stored]);
    }
    return Bytes().add(p.loads).add(p.loaded).add(rows).add(record).add(stored);
}

TEST(InstructionSets, GiveTheSameForcesBetweenParticles) {
    for_each_set([](std::string_view isa, const Kernels& kernels) {
        for (const LawChoice& c : law_choices()) {
            for (const Records records : {Records::none, Records::all, Records::stored_energy}) {
                for (Index n = 1; n <= most_contacts; ++n) {
                    EXPECT_TRUE(pair_forces(kernels, c, records, n) ==
                                pair_forces(kernels_for("scalar"), c, records, n))
                        << isa << ", laws " << testing::PrintToString(c) << ", " << n
                        << " contacts";
                }
            }
        }
    });
}

Bytes wall_forces(const Kernels& kernels,
                  const LawChoice& choice,
                  Records records,
                  Index count,
                  bool general = false) {
    const std::uint64_t seed = seed_of(choice) + count;
    RandomParticles p(particle_count, seed);
    const ContactTable table = random_table(choice, seed);
    std::mt19937_64 random(seed);
    const Index packets = history_packets(table.history_size()) + 1;
    Column<double> rows = random_rows(count, packets, random);
    std::vector<Index> particle(count);
    std::vector<TouchingContact> touching;
    for (Index t = 0; t < count; ++t) {
        particle[t] = t * particle_count / (count + 1);  // ascending, some with several contacts
        const Vec3 n = normalized(
            {between(random, -1.0, 1.0), between(random, -1.0, 1.0), between(random, -1.0, 1.0)});
        const double geometry[4] = {n.x, n.y, n.z, between(random, 0.0025, 0.0055)};
        std::copy_n(geometry, 4, &rows[4 * (std::size_t{packets} * t + packets - 1)]);
        touching.emplace_back(t, random() % 2 == 0);
    }
    Column<double> force(4 * std::size_t{count}, 0.0);
    Column<double> record(static_cast<std::size_t>(count) * record_size);
    Column<double> stored(count);
    kernels.wall_pass({.particles = p.view(),
                       .laws = laws_of(table, general),
                       .particle = particle.data(),
                       .touching = touching.data(),
                       .touching_count = count,
                       .velocity = {0.3, -0.7, 0.2},
                       .spin = {1.0, -3.0, 2.0},
                       .centre = {0.01, -0.02, 0.03},
                       .material = 2.0,
                       .rows = rows.data(),
                       .force = force.data(),
                       .records = records == Records::all ? record.data() : nullptr,
                       .stored = records == Records::none ? nullptr : stored.data()});
    for (std::size_t t = 0; records == Records::all && t < stored.size(); ++t) {
        EXPECT_EQ(stored[t], record[t * record_size + record_stored]);
    }
    return Bytes().add(p.loads).add(p.loaded).add(rows).add(force).add(record).add(stored);
}

TEST(InstructionSets, GiveTheSameForcesOnWalls) {
    for_each_set([](std::string_view isa, const Kernels& kernels) {
        for (const LawChoice& c : law_choices()) {
            for (const Records records : {Records::none, Records::all, Records::stored_energy}) {
                for (Index n = 1; n <= most_contacts; ++n) {
                    EXPECT_TRUE(wall_forces(kernels, c, records, n) ==
                                wall_forces(kernels_for("scalar"), c, records, n))
                        << isa << ", laws " << testing::PrintToString(c) << ", " << n
                        << " contacts";
                }
            }
        }
    });
}

TEST(GeneralPass, GivesTheForcesOfEveryPassOfItsOwn) {
    for (std::size_t n = 0; !available_isa(n).empty(); ++n) {
        const Kernels& kernels = kernels_for(available_isa(n));
        for (const LawChoice& c : law_choices()) {
            for (const Records records : {Records::none, Records::all, Records::stored_energy}) {
                for (const Index count : {1U, 7U, 8U, 9U, 33U}) {
                    EXPECT_TRUE(pair_forces(kernels, c, records, count, true) ==
                                pair_forces(kernels, c, records, count))
                        << kernels.isa << ", laws " << testing::PrintToString(c) << ", " << count
                        << " contacts";
                    EXPECT_TRUE(wall_forces(kernels, c, records, count, true) ==
                                wall_forces(kernels, c, records, count))
                        << kernels.isa << ", laws " << testing::PrintToString(c) << ", " << count
                        << " contacts with walls";
                }
            }
        }
    }
}

Bytes step_sums(const Kernels& kernels, const LawChoice& choice, Index count, bool rotation_rules) {
    const std::uint64_t seed = seed_of(choice) + count;
    RandomParticles p(particle_count, seed);
    RandomPairs pairs(particle_count, 0, seed);
    const ContactTable table = random_table(choice, seed);
    Column<double> shear(p.position.size(), 0.0);
    Column<double> normal(p.position.size(), 0.0);
    const StepSums sums{shear.data(), rotation_rules ? nullptr : normal.data()};
    // No longer than they must be, as those of the last slab are: reading on would be a fault.
    const std::vector<Index> i(pairs.i.begin() + 3, pairs.i.begin() + 3 + count);
    const std::vector<Index> j(pairs.j.begin() + 3, pairs.j.begin() + 3 + count);
    kernels.add_pair_steps({.particles = p.view(),
                            .laws = table.view(0.0),
                            .i = i.data(),
                            .j = j.data(),
                            .count = count,
                            .sums = sums});
    std::mt19937_64 random(seed);
    std::vector<Index> particle;
    Column<double> geometry;
    for (Index t = 0; t < count; ++t) {
        particle.push_back(static_cast<Index>(random() % particle_count));
        const Vec3 n = normalized({between(random, -1.0, 1.0), between(random, -1.0, 1.0), 0.5});
        geometry.insert(geometry.end(), {n.x, n.y, n.z, 0.003});
    }
    kernels.add_wall_steps({.particles = p.view(),
                            .laws = table.view(0.0),
                            .particle = particle.data(),
                            .geometry = geometry.data(),
                            .count = count,
                            .material = 2.0,
                            .sums = sums});
    const double largest = kernels.largest_step_ratio(p.view(), sums, false);
    EXPECT_GT(largest, 0.0);
    const Bytes result = Bytes().add(shear).add(normal).add(&largest, 1);
    EXPECT_EQ(kernels.largest_step_ratio(p.view(), sums, true), largest);
    const auto is_zero = [](double x) { return x == 0.0; };
    EXPECT_TRUE(std::all_of(shear.begin(), shear.end(), is_zero));
    EXPECT_TRUE(rotation_rules || std::all_of(normal.begin(), normal.end(), is_zero));
    return result;
}

TEST(InstructionSets, GiveTheSameSumsForTheStableStep) {
    for_each_set([](std::string_view isa, const Kernels& kernels) {
        for (const LawChoice& c : law_choices()) {
            for (const Index n : {1U, 7U, 8U, 9U, 33U}) {
                for (const bool rules : {false, true}) {
                    EXPECT_TRUE(step_sums(kernels, c, n, rules) ==
                                step_sums(kernels_for("scalar"), c, n, rules))
                        << isa << ", laws " << testing::PrintToString(c) << ", " << n
                        << " contacts";
                }
            }
        }
    });
}

}  // namespace
}  // namespace grainbench::test
