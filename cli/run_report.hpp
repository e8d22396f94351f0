/// What `grainbench run` says before and after the stepping.
#pragma once

#include "core/scene.hpp"
#include "core/simulation.hpp"

#include "io/manifest.hpp"

#include <span>
#include <string>

namespace grainbench::cli {

/// One line for each realisation: particles, and of each entry of particles.insertion what was
/// asked for and what was placed.
std::string insertion_text(const Scene& scene, std::span<const Simulation> simulations);

/// \param output_share fraction of the stepping time that went into writing [1]
std::string summary_text(const io::Manifest& manifest, double output_share);

}  // namespace grainbench::cli
