#include "core/measure/contact_scales.hpp"

#include "core/contact/contact_table.hpp"
#include "core/integrate/stable_step.hpp"
#include "core/state/particle_state.hpp"

#include <algorithm>
#include <limits>

namespace grainbench {

namespace {

/// The smallest sphere of each species that has any.
std::vector<Sphere> smallest_spheres(const Scene& scene, const ParticleFrame& particles) {
    std::vector<Sphere> spheres;
    for (Index species = 0; species < scene.particles.species.size(); ++species) {
        double smallest = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < particles.size(); ++k) {
            if (particles.species[k] == static_cast<std::int32_t>(species)) {
                smallest = std::min(smallest, particles.radius[k]);
            }
        }
        if (std::isfinite(smallest)) {
            Sphere sphere;
            sphere.species = species;
            sphere.radius = smallest;
            spheres.push_back(sphere);
        }
    }
    return spheres;
}

double mass_of(const Scene& scene, const Sphere& sphere) {
    return 4.0 / 3.0 * pi * sphere.radius * sphere.radius * sphere.radius *
           scene.particles.species[sphere.species].density;
}

ContactTime contact_time(
    std::string first, std::string second, double stiffness, double mass, double radius) {
    return {std::move(first),
            std::move(second),
            stiffness,
            mass,
            radius,
            pi * std::sqrt(mass / stiffness)};  // (1)
}

/// The limit of one sphere that touches one material; the same formula as StableStep's.
SingleContactLimit limit_of(const Scene& scene,
                            const Sphere& sphere,
                            const std::string& partner,
                            const StepStiffness& stiffness) {
    SingleContactLimit limit;
    limit.species = scene.particles.species[sphere.species].name;
    limit.partner = partner;
    limit.mass = mass_of(scene, sphere);
    limit.radius = sphere.radius;
    limit.stiffness_n = stiffness.normal;
    limit.stiffness_s = stiffness.shear;
    const double inertia = 0.4 * limit.mass * limit.radius * limit.radius;
    const double translation = limit.stiffness_n / limit.mass;
    const double rotation = limit.stiffness_s * limit.radius * limit.radius / inertia;
    limit.rotation_rules = rotation > translation;
    limit.timestep = 1.0 / std::sqrt(std::max(translation, rotation));
    return limit;
}

}  // namespace

ContactScales contact_scales(const Scene& scene,
                             const Contact& contact,
                             const ParticleFrame& particles) {
    const Materials materials(scene);
    const ContactTable table(contact, materials);
    const std::vector<Sphere> spheres = smallest_spheres(scene, particles);
    const auto species_count = static_cast<Index>(scene.particles.species.size());
    ContactScales scales;
    scales.history_size = table.history_size();
    scales.limit.timestep = std::numeric_limits<double>::infinity();
    for (const Sphere& i : spheres) {
        for (const Sphere& j : spheres) {
            if (i.species <= j.species) {
                const double m_i = mass_of(scene, i);
                const double m_j = mass_of(scene, j);
                scales.times.push_back(
                    contact_time(materials.names()[i.species],
                                 materials.names()[j.species],
                                 table.stiffness(i.species, j.species, i.radius, j.radius).normal,
                                 m_i * m_j / (m_i + m_j),
                                 std::min(i.radius, j.radius)));
            }
        }
        for (Index material = 0; material < materials.count(); ++material) {
            const SingleContactLimit limit =
                limit_of(scene,
                         i,
                         materials.names()[material],
                         table.step_stiffness(i.species, material, i.radius, 0.0));
            if (limit.timestep < scales.limit.timestep) {
                scales.limit = limit;
            }
            if (material >= species_count) {
                scales.times.push_back(
                    contact_time(materials.names()[i.species],
                                 materials.names()[material],
                                 table.stiffness(i.species, material, i.radius, 0.0).normal,
                                 mass_of(scene, i),
                                 i.radius));
            }
        }
    }
    std::stable_sort(
        scales.times.begin(), scales.times.end(), [](const ContactTime& a, const ContactTime& b) {
            return a.duration < b.duration;
        });
    return scales;
}

double surest_approach_speed(const Detection& detection,
                             double smallest_radius,
                             double timestep,
                             std::int64_t cycles) {
    return detection.tolerance * smallest_radius / (static_cast<double>(cycles) * timestep);  // (2)
}

double fastest_wall(const Scene& scene) {
    double fastest = 0.0;
    const auto look = [&](const WallMotion& motion) {
        const double speed =
            std::visit(Overloaded{[](const ConstantMotion& m) { return norm(m.velocity); },
                                  [](const SinusoidMotion& m) { return norm(m.velocity); },
                                  [](const SmoothedSquareMotion& m) { return m.amplitude; },
                                  [](const TableMotion& m) {
                                      double largest = 0.0;
                                      for (const double v : m.speeds) {
                                          largest = std::max(largest, std::abs(v));
                                      }
                                      return largest;
                                  },
                                  [](const auto&) { return 0.0; }},
                       motion);
        fastest = std::max(fastest, speed);
    };
    for (const Wall& wall : scene.walls) {
        look(wall.motion);
    }
    for (const Stage& stage : scene.stages) {
        for (const StageMotion& change : stage.motions) {
            look(change.motion);
        }
    }
    return fastest;
}

}  // namespace grainbench
