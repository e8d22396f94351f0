/// Which patches of one wall are near which particles: what contact objects are chosen from.
#pragma once

#include "core/archive.hpp"
#include "core/parallel/workers.hpp"
#include "core/search/candidates.hpp"
#include "core/search/list_clock.hpp"
#include "core/walls/wall_body.hpp"

#include <span>
#include <string>
#include <vector>

namespace grainbench {

/// Candidates are found some way in advance, particle by particle: one that has not come as far
/// since keeps its own.
class WallCandidates {
public:
    /// Lists the patches within reach of each particle, as the clock says.
    void build(const ListClock& clock,
               const ParticleState& particles,
               const WallBody& wall,
               const Workers& workers);

    /// Of other particles, or other slots.
    void forget();

    /// Particle, patch; by particle.
    const PairList& list() const { return list_; }

    void save(Archive& archive, const std::string& name) const;
    void load(const Archive& archive,
              const std::string& name,
              std::size_t particle_count,
              std::size_t patch_count);

private:
    /// How far a particle was from the patches that are not its candidates when it was last looked
    /// at.
    struct Clearance {
        Vec3 centre{};          ///< [m] in the wall's frame
        double distance = 0.0;  ///< [m] to the nearest of them, or less

        /// Whether they must be farther than `reach` from a particle that has come to `now`.
        bool exceeds(const Vec3& now, double reach) const {
            constexpr double rounding = 1e-9;
            const double left = (1.0 - rounding) * distance - reach;
            const Vec3 way = now - centre;
            return left > 0.0 && dot(way, way) < left * left;
        }
    };

    std::vector<double> packed_clearances() const;
    void load_clearances(std::span<const double> packed, std::size_t size);

    PairList list_;
    std::vector<Clearance> clearances_;  ///< by slot
};

}  // namespace grainbench
