#include "core/search/candidates.hpp"

#include <algorithm>

namespace grainbench {

std::int64_t CandidateFinder::Grid::coordinate(double x, int axis) const {
    const double low_axis = axis == 0 ? low.x : axis == 1 ? low.y : low.z;
    const auto cell = static_cast<std::int64_t>((x - low_axis) * inverse_edge);
    return std::clamp<std::int64_t>(cell, 0, cells[axis] - 1);
}

void CandidateFinder::sort_into_cells(const ParticleState& particles, double edge) {
    const Index n = particles.size();
    Vec3 low = particles.position(0);
    Vec3 high = low;
    for (Index s = 1; s < n; ++s) {
        const Vec3 p = particles.position(s);
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    // A stray particle far away must not make the grid huge: coarsen until it is about one cell
    // each.
    const Vec3 size = high - low;
    const auto cells_along = [&](double length) {
        return static_cast<std::int64_t>(std::min(length / edge, 1e6)) + 1;
    };
    const std::int64_t most = 4 * static_cast<std::int64_t>(n) + 1024;
    while (cells_along(size.x) * cells_along(size.y) * cells_along(size.z) > most) {
        edge *= 1.26;
    }
    grid_ = {low, 1.0 / edge, {cells_along(size.x), cells_along(size.y), cells_along(size.z)}};

    const auto cell_count =
        static_cast<std::size_t>(grid_.cells[0] * grid_.cells[1] * grid_.cells[2]);
    cell_start_.assign(cell_count + 1, 0);
    cell_of_.resize(n);
    for (Index s = 0; s < n; ++s) {
        const Vec3 p = particles.position(s);
        const std::int64_t cell =
            (grid_.coordinate(p.z, 2) * grid_.cells[1] + grid_.coordinate(p.y, 1)) *
                grid_.cells[0] +
            grid_.coordinate(p.x, 0);
        cell_of_[s] = static_cast<std::uint32_t>(cell);
        ++cell_start_[cell_of_[s] + 1];
    }
    for (std::size_t c = 1; c <= cell_count; ++c) {
        cell_start_[c] += cell_start_[c - 1];
    }
    slot_.resize(n);
    packet_.resize(4 * static_cast<std::size_t>(n));
    std::vector<Index> next(cell_start_.begin(), cell_start_.end() - 1);
    for (Index s = 0; s < n; ++s) {
        const Index place = next[cell_of_[s]]++;
        slot_[place] = s;
        std::copy_n(particles.positions().data() + 4 * static_cast<std::size_t>(s),
                    4,
                    packet_.data() + 4 * static_cast<std::size_t>(place));
    }
}

void CandidateFinder::find_around(Index place, double scale, double extra) {
    const double* p = packet_.data() + 4 * static_cast<std::size_t>(place);
    const double radius = p[3];
    const Index self = slot_[place];
    // The partner is at most as large, so this reach covers every pair that is ours to find.
    const double reach = 2.0 * scale * radius + extra;
    std::int64_t from[3];
    std::int64_t to[3];
    for (int axis = 0; axis < 3; ++axis) {
        from[axis] = grid_.coordinate(p[axis] - reach, axis);
        to[axis] = grid_.coordinate(p[axis] + reach, axis);
    }
    for (std::int64_t z = from[2]; z <= to[2]; ++z) {
        for (std::int64_t y = from[1]; y <= to[1]; ++y) {
            const std::int64_t row = (z * grid_.cells[1] + y) * grid_.cells[0];
            const Index begin = cell_start_[static_cast<std::size_t>(row + from[0])];
            const Index end = cell_start_[static_cast<std::size_t>(row + to[0]) + 1];
            for (Index q = begin; q < end; ++q) {
                const double* other = packet_.data() + 4 * static_cast<std::size_t>(q);
                const double dx = other[0] - p[0];
                const double dy = other[1] - p[1];
                const double dz = other[2] - p[2];
                const double limit = scale * (radius + other[3]) + extra;
                const bool close = dx * dx + dy * dy + dz * dz <= limit * limit;
                const Index partner = slot_[q];
                if (close && (other[3] < radius || (other[3] == radius && partner > self))) {
                    found_.emplace_back(std::min(self, partner), std::max(self, partner));
                }
            }
        }
    }
}

void CandidateFinder::order_pairs(Index particle_count, PairList& pairs) {
    row_start_.assign(static_cast<std::size_t>(particle_count) + 1, 0);
    for (const auto& [i, j] : found_) {
        ++row_start_[i + 1];
    }
    for (Index s = 0; s < particle_count; ++s) {
        row_start_[s + 1] += row_start_[s];
    }
    pairs.clear();
    pairs.i.resize(found_.size());
    pairs.j.resize(found_.size());
    pairs.count = static_cast<Index>(found_.size());
    std::vector<Index> next(row_start_.begin(), row_start_.end() - 1);
    for (const auto& [i, j] : found_) {
        const Index place = next[i]++;
        pairs.i[place] = i;
        pairs.j[place] = j;
    }
    for (Index s = 0; s < particle_count; ++s) {
        std::sort(pairs.j.begin() + row_start_[s], pairs.j.begin() + row_start_[s + 1]);
    }
    pairs.pad();
}

void CandidateFinder::find(const ParticleState& particles,
                           double scale,
                           double extra,
                           PairList& pairs) {
    found_.clear();
    if (particles.size() > 1) {
        sort_into_cells(particles, 2.0 * scale * particles.smallest_radius() + extra);
        for (Index place = 0; place < particles.size(); ++place) {
            find_around(place, scale, extra);
        }
    }
    order_pairs(particles.size(), pairs);
}

}  // namespace grainbench
