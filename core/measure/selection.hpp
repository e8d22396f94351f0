/// Which particles belong to the scene's groups, layers and traces; decided once, after insertion.
#pragma once

#include "core/scene.hpp"
#include "core/state/particle_state.hpp"

#include <vector>

namespace grainbench {

/// Slots of a group, ids ascending.
std::vector<Index> slots_of_group(const Scene& scene,
                                  const Group& group,
                                  const ParticleState& particles);

/// By slot: 1 + index of the first group that holds it, 0 if none.
std::vector<std::int32_t> group_numbers(const Scene& scene, const ParticleState& particles);

/// Number of the first group without a box that takes in a species; 0 if there is none.
std::int32_t group_of_newcomer(const Scene& scene, Index species);

/// By slot: number of the layer between two edges, 0 outside all.
std::vector<std::int32_t> layer_numbers(const Layers& layers, const ParticleState& particles);

/// By slot: equal layers between the lowest and the highest centre, 1 on top
/// (physics reference 7.2, min(count, floor((max - z) / D) + 1)).
std::vector<std::int32_t> current_layer_numbers(const Layers& layers,
                                                const ParticleState& particles);

/// Slot of the particle nearest to each trace's point. Throws Error(bad_input) if there is none.
std::vector<Index> traced_slots(const Scene& scene, const ParticleState& particles);

}  // namespace grainbench
