/// A change of who is in a running scene.
#pragma once

#include "core/insertion/insert.hpp"
#include "core/types.hpp"

#include <vector>

namespace grainbench {

/// Who goes and who comes at one instant. Those that stay keep their order, newcomers follow them.
struct PopulationChange {
    static constexpr Index gone = ~Index{0};

    std::vector<Index> slot_after;  ///< by slot before the change; `gone` where there is none
    std::vector<Sphere> newcomers;
    std::vector<Sphere> leavers;  ///< as they went, velocities at the half step
};

/// What was kept by slot before a change, in the slots after it; newcomers get `value`.
template <class T>
std::vector<T> renumbered(const std::vector<T>& by_slot,
                          const PopulationChange& change,
                          const T& value) {
    std::vector<T> after;
    for (std::size_t slot = 0; slot < by_slot.size(); ++slot) {
        if (change.slot_after[slot] != PopulationChange::gone) {
            after.push_back(by_slot[slot]);  // slots that stay keep their order
        }
    }
    after.resize(after.size() + change.newcomers.size(), value);
    return after;
}

}  // namespace grainbench
