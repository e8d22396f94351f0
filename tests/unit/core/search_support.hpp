/// What tests of the search share: random clouds of spheres and the pairs in them, looked for in
/// the obvious way.
#pragma once

#include "core/search/candidates.hpp"
#include "core/state/particle_state.hpp"

#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace grainbench {

using Pairs = std::vector<std::pair<Index, Index>>;

inline double between(std::mt19937_64& random, double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

inline Vec3 in_cube(std::mt19937_64& random, double half_edge) {
    const double x = between(random, -half_edge, half_edge);
    const double y = between(random, -half_edge, half_edge);
    return {x, y, between(random, -half_edge, half_edge)};
}

/// `count` spheres in a cube; radii from 1 mm to ratio * 1 mm, as many of each size octave.
inline std::vector<Sphere> random_cloud(int count,
                                        double ratio,
                                        double half_edge,
                                        std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::vector<Sphere> spheres;
    for (int n = 0; n < count; ++n) {
        Sphere sphere;
        sphere.radius = 0.001 * std::pow(ratio, between(random, 0.0, 1.0));
        sphere.position = in_cube(random, half_edge);
        spheres.push_back(sphere);
    }
    return spheres;
}

inline ParticleState state_of(const std::vector<Sphere>& spheres) {
    const double density[] = {1500.0};
    return {spheres, density};
}

/// Pairs whose distance is at most scale * (R_i + R_j) + extra, in lexicographic order.
inline Pairs brute_force_pairs(const ParticleState& particles, double scale, double extra) {
    Pairs pairs;
    for (Index i = 0; i < particles.size(); ++i) {
        for (Index j = i + 1; j < particles.size(); ++j) {
            const Vec3 apart = particles.position(j) - particles.position(i);
            const double reach = scale * (particles.radius(i) + particles.radius(j)) + extra;
            if (dot(apart, apart) <= reach * reach) {
                pairs.emplace_back(i, j);
            }
        }
    }
    return pairs;
}

inline Pairs pairs_of(const PairList& list) {
    Pairs pairs;
    for (Index k = 0; k < list.count; ++k) {
        pairs.emplace_back(list.i[k], list.j[k]);
    }
    return pairs;
}

/// Moves one particle, as a pass would.
inline void shift(ParticleState& particles, Index slot, const Vec3& by) {
    double* p = particles.view().position + 4 * static_cast<std::size_t>(slot);
    p[0] += by.x;
    p[1] += by.y;
    p[2] += by.z;
}

}  // namespace grainbench
