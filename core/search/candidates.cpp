#include "core/search/candidates.hpp"

#include <algorithm>
#include <utility>

namespace grainbench {

namespace {

struct PairColumns {
    Column<Index>& i;
    Column<Index>& j;
};

/// Puts the first `count` pairs of `from` in the order of their keys; equals stay in theirs.
/// \param next work space
void sort_by(const Column<Index>& key,
             Index key_end,
             std::size_t count,
             const PairColumns& from,
             const PairColumns& to,
             std::vector<Index>& next) {
    next.assign(std::size_t{key_end} + 1, 0);
    for (std::size_t k = 0; k < count; ++k) {
        ++next[key[k] + 1];
    }
    for (Index s = 0; s < key_end; ++s) {
        next[s + 1] += next[s];
    }
    for (std::size_t k = 0; k < count; ++k) {
        const Index place = next[key[k]]++;
        to.i[place] = from.i[k];
        to.j[place] = from.j[k];
    }
}

}  // namespace

void PairList::load(const Archive& archive,
                    const std::string& i_name,
                    const std::string& j_name,
                    std::size_t i_end,
                    std::size_t j_end,
                    const RowOwners& owner) {
    const auto& i_column = archive.get<Index>(i_name);
    const auto& j_column = archive.get<Index>(j_name, i_column.size());
    for (std::size_t k = 0; k < i_column.size(); ++k) {
        Archive::require(i_column[k] < i_end && j_column[k] < j_end, i_name);
        const bool is_ordered = k == 0 || std::pair(i_column[k - 1], owner(j_column[k - 1])) <
                                              std::pair(i_column[k], owner(j_column[k]));
        Archive::require(is_ordered, i_name);
    }
    i.assign(i_column.begin(), i_column.end());
    j.assign(j_column.begin(), j_column.end());
    count = static_cast<Index>(i.size());
    pad();
}

void CandidateFinder::sort_into_cells(const ParticleState& particles, double edge) {
    const Index n = particles.row_count();
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
        const double cells = length / edge;  // no number where both are infinite
        return cells >= 1.0 ? static_cast<std::int64_t>(std::min(cells, 1e6)) + 1 : 1;
    };
    const std::int64_t most = 4 * static_cast<std::int64_t>(n) + 1024;
    while (cells_along(size.x) * cells_along(size.y) * cells_along(size.z) > most) {
        edge *= 1.26;
    }
    grid_ = {{low.x, low.y, low.z},
             1.0 / edge,
             {cells_along(size.x), cells_along(size.y), cells_along(size.z)}};

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
    constexpr std::size_t spare = 8;  // that a search may read
    slot_.resize(n + spare);
    for (Column<double>* column : {&centre_[0], &centre_[1], &centre_[2], &radius_}) {
        column->resize(n + spare);
    }
    next_.assign(cell_start_.begin(), cell_start_.end() - 1);
    for (Index s = 0; s < n; ++s) {
        const Index place = next_[cell_of_[s]]++;
        slot_[place] = s;
        const Vec3 centre = particles.position(s);
        centre_[0][place] = centre.x;
        centre_[1][place] = centre.y;
        centre_[2][place] = centre.z;
        radius_[place] = particles.radius(s);
    }
}

void CandidateFinder::order_pairs(Index row_count, std::size_t found, PairList& pairs) {
    pairs.count = static_cast<Index>(found);
    pairs.pad();
    const PairColumns work{found_i_, found_j_};
    const PairColumns result{pairs.i, pairs.j};
    sort_by(work.j, row_count, found, work, result, next_);
    sort_by(result.i, row_count, found, result, work, next_);
    std::copy_n(work.i.begin(), found, result.i.begin());
    std::copy_n(work.j.begin(), found, result.j.begin());
}

void CandidateFinder::find(const ParticleState& particles,
                           double scale,
                           double extra,
                           const Kernels& kernels,
                           PairList& pairs) {
    CellSearch search{};
    if (particles.row_count() > 1) {
        sort_into_cells(particles, 2.0 * scale * particles.smallest_radius() + extra);
        search = {.grid = grid_,
                  .centre = {centre_[0].data(), centre_[1].data(), centre_[2].data()},
                  .radius = radius_.data(),
                  .slot = slot_.data(),
                  .cell_start = cell_start_.data(),
                  .count = particles.row_count(),
                  .smallest_radius = particles.smallest_radius(),
                  .scale = scale,
                  .extra = extra,
                  .i = nullptr,
                  .j = nullptr,
                  .capacity = std::max<std::size_t>({found_i_.size(), pairs.i.size(), 64})};
        while (search.next < search.count) {
            found_i_.resize(search.capacity);
            found_j_.resize(search.capacity);
            search.i = found_i_.data();
            search.j = found_j_.data();
            kernels.search_cells(search);
            search.capacity *= search.next < search.count ? 2 : 1;
        }
    }
    order_pairs(particles.row_count(), search.found, pairs);
    release_work_space();
}

void CandidateFinder::release_work_space() {
    for (Column<Index>* column : {&found_i_, &found_j_}) {
        release_if_large(*column);
    }
    for (Column<double>* column : {&centre_[0], &centre_[1], &centre_[2], &radius_}) {
        release_if_large(*column);
    }
    for (std::vector<Index>* column : {&cell_start_, &next_, &slot_}) {
        release_if_large(*column);
    }
    release_if_large(cell_of_);
}

}  // namespace grainbench
