/// The few scenes that the cases are made of: spheres of the example, planes, and contact laws by
/// their numbers.
#pragma once

#include "core/scene.hpp"

#include <optional>
#include <string>

namespace grainbench::verify {

/// A solid sphere.
struct Sphere {
    double radius = 0.003;    ///< [m]
    double density = 1500.0;  ///< [kg/m^3]

    double mass() const { return 4.0 / 3.0 * pi * radius * radius * radius * density; }
};

/// The small sphere of the example and its intruder.
inline constexpr Sphere small_sphere{};
inline constexpr Sphere intruder{.radius = 0.006, .density = 2500.0};

/// Contact laws by their numbers; what is absent is off.
struct Laws {
    double normal = 1e5;               ///< [N/m]
    double shear = 0.0;                ///< [N/m]
    bool incremental = false;          ///< the normal spring
    std::optional<double> friction{};  ///< [1]
    std::optional<double> damping{};   ///< [1] ratio, normal and shear alike
    int damping_mode = 0;
};

Contact contact_of(const Laws& laws);

/// No gravity, walls or spheres yet; one species, "ball", one stage.
Scene scene_of(const Laws& laws,
               double timestep,
               double duration,
               const Sphere& sphere = small_sphere);

/// Spheres get the ids 1, 2, ... in the order of these calls.
void add_sphere(Scene& scene,
                const Vec3& position,
                const Vec3& velocity = {},
                const Vec3& spin = {},
                const std::string& species = "ball");

void add_species(Scene& scene, const std::string& name, const Sphere& sphere);

void add_plane(Scene& scene, const std::string& name, const Vec3& point, const Vec3& normal);

/// Gives contacts of two materials their own constant stiffness.
void set_stiffness(
    Scene& scene, const std::string& a, const std::string& b, double normal, double shear = 0.0);

AutomaticTimestep automatic_step(double safety_factor);

/// Half the period of the undamped oscillator: duration of an undamped normal impact [s].
double half_period(double mass, double stiffness);

}  // namespace grainbench::verify
