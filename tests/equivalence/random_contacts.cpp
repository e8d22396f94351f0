#include "tests/equivalence/random_contacts.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace grainbench::test {

namespace {

/// Laws with random numbers, of the kinds that the choice asks for.
PairContact random_pair(const LawChoice& choice, std::mt19937_64& random) {
    PairContact pair;
    if (choice[stiffness_slot] == 0) {
        pair.stiffness = ConstantStiffness::Params{.normal = between(random, 1e3, 1e5),
                                                   .shear = between(random, 1e3, 1e5)};
    } else if (choice[stiffness_slot] == 1) {
        pair.stiffness = DeformabilityStiffness::Params{.modulus = between(random, 1e6, 1e8),
                                                        .ratio = between(random, 0.5, 3.0)};
    } else {
        pair.stiffness = HertzStiffness::Params{.young_modulus = between(random, 1e6, 1e8),
                                                .poisson_ratio = between(random, 0.0, 0.5)};
    }
    const std::array<NormalLaw, 5> springs{LinearSpring::Params{},
                                           IncrementalSpring::Params{},
                                           HertzSpring::Params{},
                                           JkrAdhesion::Params{between(random, 0.1, 10.0)},
                                           WaltonBraunSpring::Params{between(random, 0.1, 1.0)}};
    pair.normal = springs[choice[normal_slot]];
    if (choice[friction_slot] == 1) {
        pair.friction = CoulombFriction::Params{.coefficient = between(random, 0.0, 1.0)};
    } else if (choice[friction_slot] == 2) {
        pair.friction = MindlinFriction::Params{.coefficient = between(random, 0.0, 1.0)};
    }
    if (choice[damping_slot] == 1) {
        pair.damping = ViscousDamping::Params{.normal = between(random, 0.0, 0.5),
                                              .shear = between(random, 0.0, 0.5),
                                              .mode = static_cast<std::int64_t>(random() % 4)};
    } else if (choice[damping_slot] == 2) {
        pair.damping = RestitutionDamping::Params{between(random, 0.1, 1.0)};
    }
    if (choice[cohesion_slot] == 1) {
        pair.cohesion =
            LinearCohesion::Params{between(random, 0.0, 1.0), between(random, 1e-4, 1e-3)};
    }
    if (choice[rolling_slot] == 1) {
        pair.rolling =
            RollingResistance::Params{between(random, 0.0, 0.5), between(random, 0.1, 2.0)};
    }
    if (choice[twisting_slot] == 1) {
        pair.twisting =
            TwistingResistance::Params{between(random, 0.0, 0.5), between(random, 0.1, 2.0)};
    }
    return pair;
}

/// The rules of io/json/procedure_rules.cpp that matter for a single contact.
bool goes_together(const LawChoice& c) {
    const bool hertzian = c[stiffness_slot] == index_of<HertzStiffness, stiffness_slot>();
    const bool has_hertz_spring = c[normal_slot] == index_of<HertzSpring, normal_slot>();
    const bool is_jkr = c[normal_slot] == index_of<JkrAdhesion, normal_slot>();
    const bool is_linear = c[normal_slot] == index_of<LinearSpring, normal_slot>();
    const bool has_friction = c[friction_slot] != 0;
    return hertzian == (has_hertz_spring || is_jkr) &&
           (!has_friction ||
            hertzian == (c[friction_slot] == index_of<MindlinFriction, friction_slot>())) &&
           (c[cohesion_slot] == 0 || has_hertz_spring || is_linear) &&
           (has_friction || (c[rolling_slot] == 0 && c[twisting_slot] == 0));
}

}  // namespace

double between(std::mt19937_64& random, double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

RandomParticles::RandomParticles(Index particle_count, std::uint64_t seed) : count(particle_count) {
    std::mt19937_64 random(seed);
    const std::size_t padded = (static_cast<std::size_t>(count) + 7) / 8 * 8;
    position.assign(4 * padded, 0.0);
    velocity.assign(4 * padded, 0.0);
    spin.assign(4 * padded, 0.0);
    loads.assign(load_row * padded, 0.0);
    loaded.assign(padded, 0);
    for (std::size_t row = 0; row < count; ++row) {
        double* const place = &position[4 * row];
        double* const load = &loads[load_row * row];
        for (std::size_t c = 0; c < 3; ++c) {
            place[c] = between(random, -0.004, 0.004);
            velocity[4 * row + c] = between(random, -2.0, 2.0);
            spin[4 * row + c] = between(random, -100.0, 100.0);
            load[force_packet + c] = between(random, -1.0, 1.0);
            load[torque_packet + c] = between(random, -1e-3, 1e-3);
        }
        const double radius = between(random, 0.003, 0.006);
        const double inverse = 1.0 / (6e3 * radius * radius * radius);
        place[3] = radius;
        velocity[4 * row + 3] = inverse;
        spin[4 * row + 3] = static_cast<double>(random() % 2);
        load[torque_packet + 3] = inverse / (0.4 * radius * radius);
        loaded[row] = 1;
    }
    std::copy_n(&position[0], 3, &position[4]);
}

ParticleView RandomParticles::view() {
    return {position.data(),
            velocity.data(),
            spin.data(),
            loads.data(),
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

std::vector<LawChoice> law_choices() {
    std::vector<LawChoice> choices;
    for (std::size_t c = 0; c < combination_count(); ++c) {
        if (goes_together(choice_of(c))) {
            choices.push_back(choice_of(c));
        }
    }
    return choices;
}

ContactTable random_table(const LawChoice& choice, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    Scene scene;
    scene.particles.species = {{"a", 1.0, 1.0}, {"b", 1.0, 1.0}, {"wall", 1.0, 1.0}};
    Contact contact;
    const PairContact base = random_pair(choice, random);
    contact.stiffness = *base.stiffness;
    contact.normal = *base.normal;
    contact.friction = base.friction;
    contact.damping = base.damping;
    contact.cohesion = base.cohesion;
    contact.rolling = base.rolling;
    contact.twisting = base.twisting;
    for (const auto& [a, b] : std::initializer_list<std::pair<const char*, const char*>>{
             {"a", "a"}, {"a", "b"}, {"b", "b"}, {"a", "wall"}, {"b", "wall"}}) {
        contact.pairs.push_back(random_pair(choice, random));
        contact.pairs.back().between = {a, b};
    }
    return {contact, Materials(scene)};
}

}  // namespace grainbench::test
