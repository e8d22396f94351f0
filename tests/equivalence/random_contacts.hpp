/// Random input for the passes: particles that overlap, in columns as the engine keeps them.
#pragma once

#include "core/contact/contact_table.hpp"
#include "core/kernels/kernels.hpp"
#include "core/state/aligned.hpp"

#include <cstdint>
#include <random>
#include <vector>

namespace grainbench::test {

/// All columns that a pass writes to, and those it reads. Copies are independent.
struct RandomParticles {
    /// `count` spheres of two materials in a cube so small that most touch; two share their centre.
    RandomParticles(Index count, std::uint64_t seed);

    ParticleView view();

    Index count = 0;
    Column<double> position, velocity, spin, loads;
    Column<std::uint8_t> loaded;
};

/// Pairs (i, j) in lexicographic order, padded as lists of the engine are; `touching` names some of
/// them.
struct RandomPairs {
    RandomPairs(Index particle_count, Index touching_count, std::uint64_t seed);

    Index count = 0;
    Column<Index> i, j;
    std::vector<TouchingContact> touching;
};

/// Uniform in [low, high).
double between(std::mt19937_64& random, double low, double high);

/// All combinations of laws that a scene may have.
std::vector<LawChoice> law_choices();

/// Laws of one combination with other numbers for every pair of two materials and a wall's.
ContactTable random_table(const LawChoice& choice, std::uint64_t seed);

}  // namespace grainbench::test
