#include "core/measure/mixing.hpp"

#include <array>
#include <map>

namespace grainbench {

namespace {

/// 1 + index of the group of that name.
std::int32_t number_of(const Scene& scene, const std::string& name) {
    std::int32_t number = 0;
    for (std::size_t g = scene.groups.size(); g-- > 0;) {
        if (scene.groups[g].name == name) {
            number = static_cast<std::int32_t>(g + 1);
        }
    }
    return number;
}

/// Particles of one cell.
struct CellCounts {
    double first = 0.0;
    double both = 0.0;
};

/// By the three numbers of a cell; ordered, so that sums have one order.
using CellMap = std::map<std::array<double, 3>, CellCounts>;

}  // namespace

Mixing::Mixing(const Scene& scene)
    : first_(number_of(scene, scene.observables.mixing->first)),
      second_(number_of(scene, scene.observables.mixing->second)),
      cell_(scene.observables.mixing->cell) {}

void Mixing::name_columns(std::vector<HistoryColumn>& columns) const {
    columns.push_back({"mixing_index", "1", "Lacey's: 0 apart, 1 as if dealt at random"});
    columns.push_back({"segregation_intensity", "1", "Danckwerts': 1 apart, 0 alike everywhere"});
    columns.push_back({"mixing_cells", "1", "cells that hold a particle of either group"});
}

void Mixing::append_row(const MeasureView& view, std::vector<double>& row) const {
    CellMap cells;
    CellCounts sum;
    for (Index slot = 0; slot < view.particles.size(); ++slot) {
        const std::int32_t group = view.groups[slot];
        if (group != first_ && group != second_) {
            continue;
        }
        const Vec3 p = view.position(slot);
        CellCounts& cell =
            cells[{std::floor(p.x / cell_), std::floor(p.y / cell_), std::floor(p.z / cell_)}];
        const double is_first = group == first_ ? 1.0 : 0.0;
        cell.first += is_first;
        cell.both += 1.0;
        sum.first += is_first;
        sum.both += 1.0;
    }
    const double share = ratio(sum.first, sum.both);
    double variance = 0.0;
    for (const auto& [place, cell] : cells) {
        const double deviation = cell.first / cell.both - share;
        variance += cell.both * deviation * deviation;
    }
    variance = ratio(variance, sum.both);  // (2)
    const auto count = static_cast<double>(cells.size());
    const double apart = share * (1.0 - share);
    // (1) with (3); the factor is exactly 0 where every cell holds one particle.
    const double factor = ratio(sum.both - count, sum.both - 1.0);
    row.push_back(ratio(apart - variance, apart * factor));
    row.push_back(ratio(variance, apart));  // (4)
    row.push_back(count);
}

}  // namespace grainbench
