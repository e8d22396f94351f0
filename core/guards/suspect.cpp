#include "core/guards/suspect.hpp"

#include "core/engine.hpp"

#include <array>
#include <cstdio>

namespace grainbench {

namespace {

std::string triple_of(const Vec3& v) {
    std::array<char, 96> text{};
    std::snprintf(text.data(), text.size(), "(%.6g, %.6g, %.6g)", v.x, v.y, v.z);
    return text.data();
}

/// Names of what touches a particle, with its velocity, the first few of them.
std::string partners_of(const Engine& engine, Index slot) {
    constexpr std::size_t most = 4;
    std::string names;
    std::size_t count = 0;
    const auto add = [&](const std::string& name) {
        if (++count <= most) {
            names += (names.empty() ? "" : ", ") + name;
        }
    };
    for (const TouchingContact contact : engine.pairs().touching()) {
        const Index i = engine.pairs().objects().i[contact.place()];
        const Index j = engine.particles().owner(engine.pairs().objects().j[contact.place()]);
        if (i == slot || j == slot) {
            add(name_of(engine, i == slot ? j : i));
        }
    }
    for (std::size_t w = 0; w < engine.walls().size(); ++w) {
        const WallContacts& contacts = engine.wall_contacts()[w];
        for (Index t = 0; t < contacts.touching_count(); ++t) {
            if (contacts.particle(t) == slot) {
                add("wall '" + engine.walls()[w].name() + "'");
            }
        }
    }
    if (count == 0) {
        return "nothing";
    }
    return names + (count > most ? " and " + std::to_string(count - most) + " more" : "");
}

/// Whether a particle's numbers are of any use; speeds and places beyond this are not.
bool is_sane(const Vec3& v) {
    return is_finite(v) && norm(v) < 1e30;
}

}  // namespace

std::string text_of(double number) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.6g", number);
    return text.data();
}

std::string name_of(const Engine& engine, Index slot) {
    const ParticleState& particles = engine.particles();
    return "particle " + std::to_string(particles.id(slot)) + " (" +
           engine.materials().names()[particles.species(slot)] + ")";
}

std::string circumstances(const Engine& engine, std::optional<Index> slot) {
    std::string text;
    if (slot) {
        text = "at " + triple_of(engine.particles().position(*slot)) + " m with " +
               triple_of(engine.particles().velocity(*slot)) + " m/s, touching " +
               partners_of(engine, *slot) + "; ";
    }
    return text + "cycle " + std::to_string(engine.cycle()) + ", time " + text_of(engine.time()) +
           " s, timestep " + text_of(engine.timestep()) + " s";
}

Diagnosis blame_step_or(const Engine& engine, Diagnosis otherwise) {
    const double limit = engine.single_contact_limit();
    if (std::holds_alternative<FixedTimestep>(engine.scheme()) && engine.timestep() > limit) {
        otherwise.likely_cause = "the fixed step is " + text_of(engine.timestep() / limit) +
                                 " times the stable step of one lone contact, " + text_of(limit) +
                                 " s";
        otherwise.next_step = "leave out /timestep to have it chosen, or set /timestep/value to " +
                              text_of(0.4 * limit) + " or less";
    } else if (const auto* automatic = std::get_if<AutomaticTimestep>(&engine.scheme());
               automatic != nullptr && automatic->safety_factor > 1.0) {
        otherwise.likely_cause = "the step is " + text_of(automatic->safety_factor) +
                                 " times the stable one, by its safety factor";
        otherwise.next_step = "set /timestep/safety_factor to 0.8, or leave it out";
    }
    return otherwise;
}

void throw_runaway(const Engine& engine) {
    const ParticleState& particles = engine.particles();
    std::string who = "some particle";
    std::optional<Index> suspect;
    for (Index slot = 0; slot < particles.size() && !suspect; ++slot) {
        if (!is_sane(particles.velocity(slot)) || !is_sane(particles.position(slot))) {
            suspect = slot;
            who = name_of(engine, slot);
        }
    }
    throw Error(
        ErrorKind::unstable,
        blame_step_or(engine,
                      {.what = who + " has a velocity or position that is not a finite number, "
                                     "or beyond all measure",
                       .where = circumstances(engine, suspect),
                       .likely_cause = "particles started with a large overlap or speed",
                       .next_step = "look at /particles/insertion; `grainbench check` prints the "
                                    "stable step"}));
}

}  // namespace grainbench
