/// How many cycles a scene will take, from its contact laws alone: good enough to weigh runs
/// against each other before any of them began. A dense bed takes up to twice as many, because
/// automatic steps shrink with the number of contacts.
#pragma once

#include "core/frame.hpp"
#include "core/scene.hpp"

namespace grainbench::cli {

/// Step that a scheme starts from with one lone contact [s].
/// \param limit of that contact, SingleContactLimit::timestep [s]
double planned_timestep(const Timestep& scheme, double limit);

/// A particle of each species, at rest at the origin, for what depends on their size alone.
ParticleFrame one_particle_of_each(const Scene& scene);

/// Duration of the shortest contact of all stages [s]; infinite without particles or stiffness.
double shortest_contact(const Scene& scene);

/// Over all stages [1]; what imported particles are is not looked at.
double planned_cycles(const Scene& scene);

}  // namespace grainbench::cli
