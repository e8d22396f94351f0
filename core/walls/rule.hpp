/// The rule that lets one physical contact with a wall of many patches act once.
///
/// A sphere touches a surface where the distance to it is least locally. The closest point of a
/// face always is such a place. The closest point on an edge or vertex is one only if every patch
/// there agrees: if another patch at that edge or vertex has a closer point, that one is the
/// contact. Hence face before edge before vertex, across seams of any fineness. Patches that share
/// the place find it once each, and so do coplanar faces at their seam: coinciding points merge.
#pragma once

#include "core/types.hpp"
#include "core/walls/closest.hpp"
#include "core/walls/surface.hpp"

#include <array>
#include <cstddef>
#include <span>

namespace grainbench {

namespace detail {

/// Closest points nearer to each other than this fraction of the reach are one place: the distances
/// of points 2e-8 apart (the root of the spacing of doubles) cannot be told from each other.
inline constexpr double same_place = 1e-7;

/// Hits merge within this fraction of the reach: a few times same_place, because around a vertex
/// each closest point may be at the same place as the next one without the last being so as the
/// first.
inline constexpr double merging = 10.0 * same_place;

struct Candidate {
    Closest closest;
    Index patch;
};

/// Candidates of one sphere, in ascending order of patches. When full, the closest stay: the
/// patches that could overrule a candidate are closer than it, so dropping the farthest is safe.
class Candidates {
public:
    static constexpr std::size_t capacity = 64;

    std::size_t size() const { return count_; }

    Candidate& operator[](std::size_t k) { return room_[k].candidate; }

    const Candidate& operator[](std::size_t k) const { return room_[k].candidate; }

    /// Place for the next candidate, to be filled before keep_next(): no copies in between.
    Candidate& next() { return room_[count_].candidate; }

    void keep_next() {
        if (++count_ > capacity) {
            drop_farthest();
        }
    }

private:
    /// Room without a constructor: zeroing it would cost more than the rule for two patches.
    union Room {
        Room() {}  // NOLINT(modernize-use-equals-default): a default would zero it

        Candidate candidate;
    };

    void drop_farthest() {
        std::size_t farthest = 0;
        for (std::size_t k = 1; k < count_; ++k) {
            if ((*this)[k].closest.distance > (*this)[farthest].closest.distance) {
                farthest = k;
            }
        }
        --count_;
        for (std::size_t k = farthest; k < count_; ++k) {
            (*this)[k] = (*this)[k + 1];
        }
    }

    std::array<Room, capacity + 1> room_;
    std::size_t count_ = 0;
};

inline bool is_within(double distance, const Vec3& a, const Vec3& b) {
    const Vec3 apart = a - b;
    return dot(apart, apart) <= distance * distance;
}

/// True if no other patch at the edge or vertex of candidate k has a closest point elsewhere.
template <class Patch>
bool is_local_minimum(const Candidates& candidates,
                      std::size_t k,
                      std::span<const Patch> wall,
                      double reach) {
    const Closest& mine = candidates[k].closest;
    for (std::size_t other = 0; other < candidates.size(); ++other) {
        if (other != k && has_feature(wall[candidates[other].patch], mine.feature, mine.id) &&
            !is_within(same_place * reach, mine.point, candidates[other].closest.point)) {
            return false;
        }
    }
    return true;
}

inline void keep_closest(WallHits& hits, const Candidate& candidate) {
    if (hits.count == WallHits::capacity) {
        std::size_t farthest = 0;
        for (std::size_t k = 1; k < hits.count; ++k) {
            if (hits.hit[k].distance > hits.hit[farthest].distance) {
                farthest = k;
            }
        }
        if (hits.hit[farthest].distance <= candidate.closest.distance) {
            return;
        }
        std::copy(hits.hit.begin() + farthest + 1, hits.hit.end(), hits.hit.begin() + farthest);
        --hits.count;
    }
    const Closest& c = candidate.closest;
    hits.hit[hits.count++] = {candidate.patch, c.feature, c.point, c.normal, c.distance};
}

/// Adds a hit or merges it with one at the same place, where the higher feature stands for both.
inline void accept(WallHits& hits, const Candidate& candidate, double reach) {
    const Closest& c = candidate.closest;
    for (std::size_t k = 0; k < hits.count; ++k) {
        WallHit& hit = hits.hit[k];
        if (is_within(merging * reach, hit.point, c.point)) {
            if (c.feature < hit.feature) {
                hit = {candidate.patch, c.feature, c.point, c.normal, c.distance};
            }
            return;
        }
    }
    keep_closest(hits, candidate);
}

}  // namespace detail

/// Surface::resolve for the patches of one wall.
template <class Patch>
void resolve_hits(std::span<const Patch> wall,
                  const Vec3& centre,
                  double reach,
                  std::span<const Index> patches,
                  WallHits& hits) {
    hits.count = 0;
    detail::Candidates candidates;
    for (const Index patch : patches) {
        detail::Candidate& next = candidates.next();
        if (closest_within(wall[patch], centre, reach, next.closest)) {
            next.patch = patch;
            candidates.keep_next();
        }
    }
    std::size_t nearest = 0;
    for (std::size_t k = 1; k < candidates.size(); ++k) {
        if (candidates[k].closest.distance < candidates[nearest].closest.distance) {
            nearest = k;
        }
    }
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        // The nearest of all is a contact whatever rounding makes of its neighbours.
        if (candidates[k].closest.feature == Feature::face || k == nearest ||
            detail::is_local_minimum(candidates, k, wall, reach)) {
            detail::accept(hits, candidates[k], reach);
        }
    }
}

}  // namespace grainbench
