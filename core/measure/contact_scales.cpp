#include "core/measure/contact_scales.hpp"

#include "core/contact/contact_table.hpp"
#include "core/integrate/stable_step.hpp"
#include "core/measure/softening.hpp"
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

/// With the tangent stiffness k at its full depth d, Hertz's impact has d = sqrt(15/8 m v^2 / k).
ContactTime contact_time(bool stiffens,
                         std::string first,
                         std::string second,
                         double stiffness,
                         double mass,
                         double radius) {
    constexpr double hertz_duration = 2.94328;
    const double depth = std::sqrt((stiffens ? 15.0 / 8.0 : 1.0) * mass / stiffness);
    return {std::move(first),
            std::move(second),
            stiffness,
            mass,
            radius,
            stiffens ? hertz_duration * depth : pi * std::sqrt(mass / stiffness),  // (1)
            depth};
}

/// The limit of one sphere that touches one material; the same formula as StableStep's.
SingleContactLimit limit_of(const Scene& scene,
                            const Sphere& sphere,
                            const std::string& partner,
                            const StepStiffness& stiffness,
                            double rolling,
                            double twisting) {
    SingleContactLimit limit;
    limit.species = scene.particles.species[sphere.species].name;
    limit.partner = partner;
    limit.mass = mass_of(scene, sphere);
    limit.radius = sphere.radius;
    limit.stiffness_n = stiffness.normal;
    limit.stiffness_s = stiffness.shear;
    const double inertia = 0.4 * limit.mass * limit.radius * limit.radius;
    const double translation = limit.stiffness_n / limit.mass;
    const double rotation = std::max(1.0 + rolling, twisting) * limit.stiffness_s * limit.radius *
                            limit.radius / inertia;
    limit.rotation_rules = rotation > translation;
    limit.timestep = 1.0 / std::sqrt(std::max(translation, rotation));
    return limit;
}

}  // namespace

ContactScales contact_scales(const Scene& scene,
                             const Contact& contact,
                             const ParticleFrame& particles) {
    const Materials materials(scene);
    ContactTable table(contact, materials);
    const std::vector<Sphere> spheres = smallest_spheres(scene, particles);
    const auto species_count = static_cast<Index>(scene.particles.species.size());
    ContactScales scales;
    scales.history_size = table.history_size();
    scales.history_bytes = 32 * static_cast<int>(history_packets(table.history_size()));
    scales.has_own_pass = pass_of(table.choice()) != general_pass;
    scales.reach = table.reach();
    scales.stiffens = table.stiffens();
    if (scales.stiffens) {
        scales.impact_speed = expected_impact_speed(scene, particles);
        table.expect_impacts(scales.impact_speed);
    }
    scales.limit.timestep = std::numeric_limits<double>::infinity();
    for (const Sphere& i : spheres) {
        for (const Sphere& j : spheres) {
            if (i.species <= j.species) {
                const double m_i = mass_of(scene, i);
                const double m_j = mass_of(scene, j);
                scales.times.push_back(
                    contact_time(scales.stiffens,
                                 materials.names()[i.species],
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
                         table.step_stiffness(i.species, material, i.radius, 0.0),
                         table.rolling_ratio(),
                         table.twisting_ratio());
            if (limit.timestep < scales.limit.timestep) {
                scales.limit = limit;
            }
            if (material >= species_count) {
                scales.times.push_back(
                    contact_time(scales.stiffens,
                                 materials.names()[i.species],
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

double expected_impact_speed(const Scene& scene, const ParticleFrame& particles) {
    double fastest = 0.0;
    double smallest = 0.0;
    for (std::size_t k = 0; k < particles.size(); ++k) {
        fastest = std::max(fastest, norm(particles.velocity[k]));
        smallest = k == 0 ? particles.radius[k] : std::min(smallest, particles.radius[k]);
    }
    const double fall = speed_of_fall(scene, particles) + fastest_wall(scene);
    const double g = norm(scene.gravity.value_or(Vec3{}));
    return std::max({2.0 * fastest, fall, std::sqrt(4.0 * g * smallest), 1e-6});
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
