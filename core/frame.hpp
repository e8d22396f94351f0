/// Snapshots that leave the core: particles, walls, contacts and fields at one instant, in view
/// order (sorted by id), and the columns of the history. io writes them, render reads what io
/// wrote.
#pragma once

#include "core/types.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace grainbench {

/// Particles sorted by id; all columns have the same length.
struct ParticleFrame {
    double time = 0.0;  ///< [s]
    std::uint64_t cycle = 0;
    std::vector<std::int64_t> id;             ///< from 1, in order of insertion
    std::vector<Vec3> position;               ///< [m]
    std::vector<double> radius;               ///< [m]
    std::vector<std::int32_t> species;        ///< index into Scene::particles.species
    std::vector<std::int32_t> group;          ///< 1 + index of the first group that holds it, or 0
    std::vector<std::int32_t> layer;          ///< fixed layer, 0 if none
    std::vector<std::int32_t> current_layer;  ///< layer assigned anew in this frame, 0 if none
    std::vector<Vec3> velocity;               ///< [m/s] at the full step
    std::vector<Vec3> angular_velocity;       ///< [rad/s]
    std::vector<Vec3> force;                  ///< [N] of all contacts
    std::vector<std::int32_t> contacts;       ///< touching particles and walls
    /// [1] unit quaternion (w, x, y, z) of the turn since the start; empty unless the output asks
    std::vector<std::array<double, 4>> orientation;

    std::size_t size() const { return id.size(); }
};

/// Surface of one wall, as polygons in space.
struct WallSurface {
    std::string name;
    std::vector<Vec3> points;                  ///< [m]
    std::vector<std::vector<Index>> polygons;  ///< indices into points, right-handed outward
    Vec3 velocity{};                           ///< [m/s]
    Vec3 force{};                              ///< [N] of the particles on the wall
};

struct WallFrame {
    double time = 0.0;
    std::uint64_t cycle = 0;
    std::vector<WallSurface> walls;
};

/// Touching contacts; j_id is 0 for a wall and then `wall` is 1 + the index of the wall.
struct ContactFrame {
    double time = 0.0;
    std::uint64_t cycle = 0;
    std::vector<std::int64_t> i_id, j_id;
    std::vector<std::int32_t> wall;
    std::vector<Vec3> i_position;          ///< [m] centre of i
    std::vector<Vec3> j_position;          ///< [m] centre of j, or the point on the wall
    std::vector<double> overlap;           ///< [m]
    std::vector<double> force_normal;      ///< [N] spring part, compression positive
    std::vector<double> force_tangential;  ///< [N] spring part, magnitude
    std::vector<Vec3> point;               ///< [m] contact point, in the middle of the overlap
    std::vector<Vec3> branch;              ///< [m] from i to the centre of j, or to the point
    std::vector<Vec3> force;               ///< [N] on j, all of it: springs, cohesion, dashpots
    std::vector<std::int32_t> i_species;   ///< index into Scene::particles.species
    std::vector<std::int32_t> j_species;   ///< the same, or -1 for a wall
};

/// Three rows of three.
using Tensor = std::array<double, 9>;

/// Fields at the centres of the cells of a regular grid; along x first, then y, then z. What they
/// are: core/measure/coarse_graining.hpp.
struct FieldFrame {
    double time = 0.0;
    std::uint64_t cycle = 0;
    Vec3 low{};      ///< [m] corner of the grid with the smallest coordinates
    Vec3 spacing{};  ///< [m] edges of a cell
    std::array<Index, 3> counts{};
    std::vector<double> density;               ///< [kg/m^3]
    std::vector<double> solid_fraction;        ///< [1]
    std::vector<Vec3> velocity;                ///< [m/s] zero where nothing is
    std::vector<double> granular_temperature;  ///< [m^2/s^2]
    std::vector<double> pressure;              ///< [Pa] of contacts and motion
    std::vector<Tensor> contact_stress;        ///< [Pa] compression positive
    std::vector<Tensor> kinetic_stress;        ///< [Pa]
};

struct HistoryColumn {
    std::string name;
    std::string unit;
    std::string doc;
};

/// One traced particle at one instant.
struct TracePoint {
    std::int64_t id = 0;
    Vec3 position{};
    Vec3 velocity{};
};

}  // namespace grainbench
