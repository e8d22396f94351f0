#include "tests/equivalence/random_contacts.hpp"

#include <algorithm>
#include <utility>

namespace grainbench::test {

namespace {

/// One stiffness law, friction and damping at random, of the kinds that the choice asks for.
PairContact random_pair(const LawChoice& choice, std::mt19937_64& random) {
    PairContact pair;
    if (choice[0] == 0) {
        pair.stiffness = ConstantStiffness::Params{.normal = between(random, 1e3, 1e5),
                                                   .shear = between(random, 1e3, 1e5)};
    } else {
        pair.stiffness = DeformabilityStiffness::Params{.modulus = between(random, 1e6, 1e8),
                                                        .ratio = between(random, 0.5, 3.0)};
    }
    if (choice[2] != 0) {
        pair.friction = CoulombFriction::Params{.coefficient = between(random, 0.0, 1.0)};
    }
    if (choice[3] != 0) {
        pair.damping = ViscousDamping::Params{.normal = between(random, 0.0, 0.5),
                                              .shear = between(random, 0.0, 0.5),
                                              .mode = static_cast<std::int64_t>(random() % 4)};
    }
    return pair;
}

}  // namespace

double between(std::mt19937_64& random, double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

RandomParticles::RandomParticles(Index particle_count, std::uint64_t seed) : count(particle_count) {
    std::mt19937_64 random(seed);
    const std::size_t padded = (static_cast<std::size_t>(count) + 7) / 8 * 8;
    for (Column<double>* column : {&position, &velocity, &spin, &force, &torque}) {
        column->assign(4 * padded, 0.0);
    }
    loaded.assign(padded, 0);
    for (std::size_t k = 0; k < 4 * static_cast<std::size_t>(count); k += 4) {
        for (std::size_t c = 0; c < 3; ++c) {
            position[k + c] = between(random, -0.004, 0.004);
            velocity[k + c] = between(random, -2.0, 2.0);
            spin[k + c] = between(random, -100.0, 100.0);
            force[k + c] = between(random, -1.0, 1.0);
            torque[k + c] = between(random, -1e-3, 1e-3);
        }
        position[k + 3] = between(random, 0.003, 0.006);
        const double inverse = 1.0 / (6e3 * position[k + 3] * position[k + 3] * position[k + 3]);
        velocity[k + 3] = inverse;
        spin[k + 3] = static_cast<double>(random() % 2);
        torque[k + 3] = inverse / (0.4 * position[k + 3] * position[k + 3]);
        loaded[k / 4] = 1;
    }
    std::copy_n(&position[0], 3, &position[4]);
}

ParticleView RandomParticles::view() {
    return {position.data(),
            velocity.data(),
            spin.data(),
            force.data(),
            torque.data(),
            loaded.data(),
            count,
            loaded.size()};
}

RandomPairs::RandomPairs(Index particle_count, Index touching_count, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    for (Index a = 0; a < particle_count; ++a) {
        for (Index b = a + 1; b < particle_count; ++b) {
            i.push_back(a);
            j.push_back(b);
            touching.emplace_back(count++, random() % 2 == 0);
        }
    }
    while (touching.size() > touching_count) {
        touching.erase(touching.begin() + static_cast<std::ptrdiff_t>(random() % touching.size()));
    }
    const std::size_t padded = (count + 63) / 64 * 64;
    i.resize(padded, 0);
    j.resize(padded, 0);
}

ContactTable random_table(std::size_t combination, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const LawChoice choice = choice_of(combination);
    Scene scene;
    scene.particles.species = {{"a", 1.0, 1.0}, {"b", 1.0, 1.0}, {"wall", 1.0, 1.0}};
    Contact contact;
    const PairContact base = random_pair(choice, random);
    contact.stiffness = *base.stiffness;
    contact.friction = base.friction;
    contact.damping = base.damping;
    if (choice[1] == 0) {
        contact.normal = LinearSpring::Params{};
    } else {
        contact.normal = IncrementalSpring::Params{};
    }
    for (const auto& [a, b] : std::initializer_list<std::pair<const char*, const char*>>{
             {"a", "a"}, {"a", "b"}, {"b", "b"}, {"a", "wall"}, {"b", "wall"}}) {
        contact.pairs.push_back(random_pair(choice, random));
        contact.pairs.back().between = {a, b};
    }
    return {contact, Materials(scene)};
}

}  // namespace grainbench::test
