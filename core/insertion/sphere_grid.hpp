/// Spheres placed so far, binned so that a new one is tested against its neighbours only.
#pragma once

#include "core/types.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace grainbench {

/// One hashed grid per power of two of the radius: cells as wide as the spheres they hold, so that
/// wide size distributions stay cheap. Cells that share a bucket cost time, never correctness.
class SphereGrid {
public:
    /// \param radii [m] all radii that will ever be added
    explicit SphereGrid(const std::vector<double>& radii) {
        for (const double radius : radii) {
            Level& level = levels_[std::ilogb(radius)];
            level.largest = std::max(level.largest, radius);
            level.per_length = 0.5 / level.largest;
        }
    }

    void add(const Vec3& centre, double radius) {
        Level& level = levels_.at(std::ilogb(radius));
        if (level.entries.size() >= level.heads.size()) {
            level.grow();
        }
        level.entries.push_back({centre, radius, none});
        level.link(static_cast<Index>(level.entries.size() - 1));
    }

    /// True if a sphere there would overlap one already added; touching is not overlap.
    bool overlaps(const Vec3& centre, double radius) const {
        for (const auto& [exponent, level] : levels_) {
            if (!level.entries.empty() && level.overlaps(centre, radius)) {
                return true;
            }
        }
        return false;
    }

private:
    static constexpr Index none = ~Index{0};

    struct Entry {
        Vec3 centre;
        double radius;
        Index next;  ///< in the same bucket

        bool overlaps(const Vec3& other, double other_radius) const {
            const Vec3 apart = centre - other;
            const double sum = radius + other_radius;
            return dot(apart, apart) < sum * sum;
        }
    };

    struct Cell {
        std::int64_t x, y, z;
    };

    struct Level {
        double largest = 0.0;     ///< [m] radius
        double per_length = 0.0;  ///< [1/m] cells
        std::vector<Entry> entries;
        std::vector<Index> heads;  ///< of the buckets; a power of two

        Cell cell_of(const Vec3& p) const {
            const auto index = [&](double x) {
                return static_cast<std::int64_t>(std::floor(x * per_length));
            };
            return {index(p.x), index(p.y), index(p.z)};
        }

        std::size_t bucket_of(const Cell& cell) const {
            // Large odd multipliers spread neighbouring cells over the buckets.
            const auto mixed = static_cast<std::uint64_t>(cell.x) * 0x9e3779b97f4a7c15U ^
                               static_cast<std::uint64_t>(cell.y) * 0xc2b2ae3d27d4eb4fU ^
                               static_cast<std::uint64_t>(cell.z) * 0x165667b19e3779f9U;
            return static_cast<std::size_t>(mixed >> 20U) & (heads.size() - 1);
        }

        void link(Index k) {
            Index& head = heads[bucket_of(cell_of(entries[k].centre))];
            entries[k].next = head;
            head = k;
        }

        void grow() {
            heads.assign(std::max<std::size_t>(64, 4 * heads.size()), none);
            for (Index k = 0; k < entries.size(); ++k) {
                link(k);
            }
        }

        bool overlaps(const Vec3& centre, double radius) const {
            const double far = radius + largest;
            const Cell low = cell_of(centre - Vec3{far, far, far});
            const Cell high = cell_of(centre + Vec3{far, far, far});
            const double cells = static_cast<double>(high.x - low.x + 1) *
                                 static_cast<double>(high.y - low.y + 1) *
                                 static_cast<double>(high.z - low.z + 1);
            if (cells > static_cast<double>(entries.size())) {
                return std::any_of(entries.begin(), entries.end(), [&](const Entry& entry) {
                    return entry.overlaps(centre, radius);
                });
            }
            for (std::int64_t z = low.z; z <= high.z; ++z) {
                for (std::int64_t y = low.y; y <= high.y; ++y) {
                    for (std::int64_t x = low.x; x <= high.x; ++x) {
                        if (bucket_overlaps(bucket_of({x, y, z}), centre, radius)) {
                            return true;
                        }
                    }
                }
            }
            return false;
        }

        bool bucket_overlaps(std::size_t bucket, const Vec3& centre, double radius) const {
            for (Index k = heads[bucket]; k != none; k = entries[k].next) {
                if (entries[k].overlaps(centre, radius)) {
                    return true;
                }
            }
            return false;
        }
    };

    std::map<int, Level> levels_;
};

}  // namespace grainbench
