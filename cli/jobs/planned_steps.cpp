#include "cli/jobs/planned_steps.hpp"

#include "core/measure/contact_scales.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace grainbench::cli {

double planned_timestep(const Timestep& scheme, double limit) {
    return std::visit(
        Overloaded{[&](const AutomaticTimestep& a) {
                       return std::min(a.safety_factor * limit,
                                       a.maximum.value_or(std::numeric_limits<double>::infinity()));
                   },
                   [](const auto& chosen) { return chosen.value; }},
        scheme);
}

ParticleFrame one_particle_of_each(const Scene& scene) {
    ParticleFrame one_of_each;
    for (std::size_t s = 0; s < scene.particles.species.size(); ++s) {
        one_of_each.id.push_back(static_cast<std::int64_t>(s) + 1);
        one_of_each.species.push_back(static_cast<std::int32_t>(s));
        one_of_each.radius.push_back(scene.particles.species[s].radius);
        one_of_each.position.push_back({});  // scales of stiffening contacts ask for fall and speed
        one_of_each.velocity.push_back({});
    }
    return one_of_each;
}

double shortest_contact(const Scene& scene) {
    const ParticleFrame one_of_each = one_particle_of_each(scene);
    const Contact* contact = &scene.contact;
    double shortest = std::numeric_limits<double>::infinity();
    for (const Stage& stage : scene.stages) {
        contact = stage.contact ? &*stage.contact : contact;
        const ContactScales scales = contact_scales(scene, *contact, one_of_each);
        if (!scales.times.empty()) {
            shortest = std::min(shortest, scales.times.front().duration);
        }
    }
    return shortest;
}

double planned_cycles(const Scene& scene) {
    const ParticleFrame one_of_each = one_particle_of_each(scene);
    const Contact* contact = &scene.contact;
    const Timestep* scheme = &scene.timestep;
    double cycles = 0.0;
    for (const Stage& stage : scene.stages) {
        contact = stage.contact ? &*stage.contact : contact;
        scheme = stage.timestep ? &*stage.timestep : scheme;
        const double step =
            planned_timestep(*scheme, contact_scales(scene, *contact, one_of_each).limit.timestep);
        cycles += std::isfinite(step) ? std::ceil(stage.duration / step) : 1.0;
    }
    return cycles;
}

}  // namespace grainbench::cli
