/// What `grainbench run` says before and after the stepping.
#pragma once

#include "core/scene.hpp"
#include "core/simulation.hpp"

#include "io/manifest.hpp"

#include <span>
#include <string>

namespace grainbench::cli {

/// "1279 particles: small placed 1211 of 100000 asked, ..."
std::string particles_text(const Scene& scene,
                           std::size_t particles,
                           std::span<const InsertionReport> reports);

/// One line for each realisation.
std::string insertion_text(const Scene& scene, std::span<const Simulation> simulations);

/// \param output_share fraction of the stepping time that went into writing [1]
std::string summary_text(const io::Manifest& manifest, double output_share);

}  // namespace grainbench::cli
