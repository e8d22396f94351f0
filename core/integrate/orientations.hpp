/// Which way particles have turned since the start, for scenes whose output asks for it; no law
/// reads it.
///
/// Model    q <- (1 + a) q / |1 + a|,  a = (0, w dt / 2)                                    (1)
/// Source   Cayley's form of a turn by the vector 2 atan(|w| dt / 2) w / |w|: it keeps |q| = 1 and
///          falls short of w dt by (|w| dt)^2 / 12 of it.
/// Symbols  q unit quaternion (w, x, y, z) that takes directions fixed to the particle at the start
///          to where they are [1]; w spin at the half step [rad/s]; dt timestep [s].
#pragma once

#include "core/archive.hpp"
#include "core/state/particle_state.hpp"

#include <array>
#include <vector>

namespace grainbench {

class Orientations {
public:
    using Quaternion = std::array<double, 4>;

    /// None has turned yet.
    explicit Orientations(Index count) : quaternions_(count, unturned) {}

    void advance(const ParticleState& particles, double timestep);

    /// Newcomers have not turned yet.
    void change_population(const PopulationChange& change) {
        quaternions_ = renumbered(quaternions_, change, unturned);
    }

    const Quaternion& of(Index slot) const { return quaternions_[slot]; }

    void save(Archive& archive) const;
    void load(const Archive& archive, Index count);

private:
    static constexpr Quaternion unturned{1.0, 0.0, 0.0, 0.0};

    std::vector<Quaternion> quaternions_;  ///< by slot
};

}  // namespace grainbench
