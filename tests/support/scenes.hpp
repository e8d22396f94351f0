/// Scenes that several tests run, built without files so that they need the core alone.
#pragma once

#include "core/scene.hpp"

#include <cstdint>

namespace grainbench::test {

/// All effects on: incremental spring, friction, damping.
Contact full_contact(double stiffness, double damping);

/// 60 spheres of three sizes that fly about in a box under gravity, with a plate that moves up and
/// down on its floor. Fixed step, no output.
Scene gas_in_box(std::uint64_t seed);

/// The container and shaking of the example (presets/scenes/calibration.json) with a shallow bed, a
/// fixed step, and gravity and damping that pack the bed at once.
Scene shaken_bed();

/// A small container whose packed bed is thrown about in two stages that differ in motion, laws and
/// timestep scheme; elevation, ledger, wall forces, history and traces are on. Three realisations.
Scene thrown_bed();

/// A bed that repeats itself along x and y, on a belt that moves along x under a slant gravity;
/// history and traces are on. Fixed step.
Scene carried_bed();

/// 13 824 spheres that fly so fast, and mix so soon, that their slots are sorted anew within some
/// hundred cycles; several slabs of slots. Fixed step, no output.
Scene mixing_gas();

/// A scene into which spheres come and from which they go: a source on top, a sink in a corner.
Scene with_traffic(Scene scene);

}  // namespace grainbench::test
