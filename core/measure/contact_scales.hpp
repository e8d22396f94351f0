/// Time scales of the contacts that a scene can have, before anything is stepped: how long a
/// collision lasts, what step one lone contact allows, and how fast an approach a search at fixed
/// intervals sees.
///
/// Model    t_c = pi sqrt(m_c / k_n); 2.94328 d / v between Hertz's spheres                 (1)
///          v = tolerance R / (N dt)                                                        (2)
/// Source   half period of the undamped oscillator (physics reference 1.9), Hertz's impact (10.2);
///          (2) is the speed at which a sphere crosses its detection tolerance between two
///          searches.
/// Symbols  t_c duration [s]; m_c effective mass [kg]; k_n [N/m]; R radius [m]; N cycles between
///          searches [1]; dt step [s]; v [m/s]; d largest overlap [m].
/// Limits   of each species the smallest sphere present stands for all: lighter means shorter.
///          Where contacts stiffen with their overlap, impacts are taken to be as fast as
///          expected_impact_speed() says.
#pragma once

#include "core/frame.hpp"
#include "core/scene.hpp"

#include <string>
#include <vector>

namespace grainbench {

/// A collision of two materials.
struct ContactTime {
    std::string first;       ///< species
    std::string second;      ///< species or wall material
    double stiffness = 0.0;  ///< [N/m] k_n
    double mass = 0.0;       ///< [kg] m_c
    double radius = 0.0;     ///< [m] of the smaller sphere
    double duration = 0.0;   ///< [s] t_c
    double depth = 0.0;      ///< [m s/m] largest overlap over the speed of an undamped impact
};

/// Step that one lone contact allows, and what it follows from.
struct SingleContactLimit {
    double timestep = 0.0;        ///< [s]
    std::string species;          ///< whose sphere sets it
    std::string partner;          ///< species or wall material it touches
    double mass = 0.0;            ///< [kg] of the sphere
    double radius = 0.0;          ///< [m]
    double stiffness_n = 0.0;     ///< [N/m] corrected for damping
    double stiffness_s = 0.0;     ///< [N/m] corrected for damping
    bool rotation_rules = false;  ///< sqrt(I / (k_s R^2)) is below sqrt(m / k_n)
};

struct ContactScales {
    std::vector<ContactTime> times;  ///< shortest first; empty without particles
    SingleContactLimit limit;
    int history_size = 0;       ///< [1] doubles that a contact remembers
    int history_bytes = 0;      ///< in whole packets
    bool has_own_pass = false;  ///< its laws are compiled in, see contact/law_table.hpp
    double reach = 0.0;         ///< [m] gap over which cohesion acts
    bool stiffens = false;      ///< stiffnesses are those at the depth of the expected impact
    double impact_speed = 0.0;  ///< [m/s] expected, where contacts stiffen
};

/// \param contact laws of the stage in question
/// \param particles those of the scene, at any time
ContactScales contact_scales(const Scene& scene,
                             const Contact& contact,
                             const ParticleFrame& particles);

/// Speed of impacts to expect: twice the fastest sphere, a fall through the bed onto the fastest
/// wall, or what falling a diameter adds [m/s].
double expected_impact_speed(const Scene& scene, const ParticleFrame& particles);

/// Fastest approach of a sphere to a wall that an interval of N cycles always sees in time, (2)
/// [m/s].
double surest_approach_speed(const Detection& detection,
                             double smallest_radius,
                             double timestep,
                             std::int64_t cycles);

/// Largest speed that the walls of a scene are asked to have, turning left out [m/s].
double fastest_wall(const Scene& scene);

}  // namespace grainbench
