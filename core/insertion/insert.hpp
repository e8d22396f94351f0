/// Brings spheres into a scene: random sequential insertion, lattices, lists, imported files.
#pragma once

#include "core/scene.hpp"
#include "core/walls/surface.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace grainbench {

/// One sphere at the start.
struct Sphere {
    Index species = 0;
    double radius = 0.0;      ///< [m]
    Vec3 position{};          ///< [m]
    Vec3 velocity{};          ///< [m/s]
    Vec3 angular_velocity{};  ///< [rad/s]
};

/// [kg] of a sphere of a density [kg/m^3] and radius [m].
inline double sphere_mass(double density, double radius) {
    return density * 4.0 / 3.0 * pi * radius * radius * radius;
}

/// What became of one entry of particles.insertion.
struct InsertionReport {
    std::int64_t asked = 0;
    std::int64_t placed = 0;
    std::int64_t tries = 0;
};

struct InsertionResult {
    std::vector<Sphere> spheres;           ///< after removal, in order of insertion
    std::vector<InsertionReport> reports;  ///< one per entry, before removal
};

/// Fills a scene. The same seed gives the same spheres on every machine.
/// \param walls one surface per Scene::walls, at their starting position
InsertionResult insert_particles(const Scene& scene,
                                 std::span<const Surface> walls,
                                 std::uint64_t seed);

}  // namespace grainbench
