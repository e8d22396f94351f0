/// A change of who is in a running scene, or of the slots they have.
#pragma once

#include "core/insertion/insert.hpp"
#include "core/types.hpp"

#include <vector>

namespace grainbench {

/// Who goes, who comes, and who has which slot, from one instant on. Newcomers have the last slots.
struct PopulationChange {
    static constexpr Index gone = ~Index{0};

    std::vector<Index> slot_after;  ///< by slot before the change; `gone` where there is none
    std::vector<Sphere> newcomers;
    std::vector<Sphere> leavers;  ///< as they went, velocities at the half step
    Index slab_size = 0;          ///< slots of a slab from here on; 0 = as before

    std::size_t size_after() const { return slot_after.size() - leavers.size() + newcomers.size(); }
};

/// What was kept by slot before a change, in the slots after it, `width` numbers each; newcomers
/// get `value`.
template <class Column>
Column renumbered(const Column& by_slot,
                  const PopulationChange& change,
                  typename Column::value_type value = {},
                  std::size_t width = 1) {
    Column after(width * change.size_after(), value);
    for (std::size_t slot = 0; slot < change.slot_after.size(); ++slot) {
        if (change.slot_after[slot] != PopulationChange::gone) {
            for (std::size_t c = 0; c < width; ++c) {
                after[width * change.slot_after[slot] + c] = by_slot[width * slot + c];
            }
        }
    }
    return after;
}

}  // namespace grainbench
