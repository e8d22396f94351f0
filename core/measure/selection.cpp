#include "core/measure/selection.hpp"

#include <algorithm>
#include <limits>

namespace grainbench {

namespace {

bool is_species(const Scene& scene,
                const ParticleState& particles,
                Index slot,
                const std::optional<std::string>& name) {
    return !name || scene.particles.species[particles.species(slot)].name == *name;
}

double coordinate(const Vec3& p, Axis axis) {
    return axis == Axis::x ? p.x : axis == Axis::y ? p.y : p.z;
}

}  // namespace

std::vector<Index> slots_of_group(const Scene& scene,
                                  const Group& group,
                                  const ParticleState& particles) {
    std::vector<Index> slots;
    for (const Index slot : particles.slots_by_id()) {
        if (is_species(scene, particles, slot, group.species) &&
            (!group.box || holds(*group.box, particles.position(slot)))) {
            slots.push_back(slot);
        }
    }
    return slots;
}

std::vector<std::int32_t> group_numbers(const Scene& scene, const ParticleState& particles) {
    std::vector<std::int32_t> numbers(particles.size(), 0);
    for (std::size_t g = scene.groups.size(); g-- > 0;) {
        for (const Index slot : slots_of_group(scene, scene.groups[g], particles)) {
            numbers[slot] = static_cast<std::int32_t>(g + 1);
        }
    }
    return numbers;
}

std::int32_t group_of_newcomer(const Scene& scene, Index species) {
    for (std::size_t g = 0; g < scene.groups.size(); ++g) {
        const Group& group = scene.groups[g];
        if (!group.box &&
            (!group.species || *group.species == scene.particles.species[species].name)) {
            return static_cast<std::int32_t>(g + 1);
        }
    }
    return 0;
}

std::vector<std::int32_t> layer_numbers(const Layers& layers, const ParticleState& particles) {
    std::vector<std::int32_t> numbers(particles.size(), 0);
    for (Index slot = 0; slot < particles.size(); ++slot) {
        const double z = coordinate(particles.position(slot), layers.axis);
        for (std::size_t n = layers.edges.size() - 1; n-- > 0;) {
            const double low = std::min(layers.edges[n], layers.edges[n + 1]);
            const double high = std::max(layers.edges[n], layers.edges[n + 1]);
            if (z >= low && z <= high) {
                numbers[slot] = static_cast<std::int32_t>(n + 1);
            }
        }
    }
    return numbers;
}

std::vector<std::int32_t> current_layer_numbers(const Layers& layers,
                                                const ParticleState& particles) {
    std::vector<std::int32_t> numbers(particles.size(), 0);
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (Index slot = 0; slot < particles.size(); ++slot) {
        const double z = coordinate(particles.position(slot), layers.axis);
        low = std::min(low, z);
        high = std::max(high, z);
    }
    const double height = (high - low) / static_cast<double>(layers.relayer_count);
    for (Index slot = 0; slot < particles.size(); ++slot) {
        const double z = coordinate(particles.position(slot), layers.axis);
        const double number = height > 0.0 ? std::floor((high - z) / height) + 1.0 : 1.0;
        numbers[slot] =
            static_cast<std::int32_t>(std::min(number, static_cast<double>(layers.relayer_count)));
    }
    return numbers;
}

std::vector<Index> traced_slots(const Scene& scene, const ParticleState& particles) {
    std::vector<Index> slots;
    for (std::size_t n = 0; n < scene.traces.size(); ++n) {
        const Trace& trace = scene.traces[n];
        double nearest = std::numeric_limits<double>::infinity();
        Index chosen = 0;
        for (const Index slot : particles.slots_by_id()) {
            const Vec3 apart = particles.position(slot) - trace.nearest_to;
            if (is_species(scene, particles, slot, trace.species) && dot(apart, apart) < nearest) {
                nearest = dot(apart, apart);
                chosen = slot;
            }
        }
        if (!std::isfinite(nearest)) {
            throw_bad_input({.what = "no particle can be traced",
                             .where = "/traces/" + std::to_string(n),
                             .likely_cause = "the scene holds no particle of that species",
                             .next_step = "check particles.insertion, or remove the trace"});
        }
        slots.push_back(chosen);
    }
    return slots;
}

}  // namespace grainbench
