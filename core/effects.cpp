#include "core/effects.hpp"

#include "core/contact/contact_table.hpp"

#include <algorithm>
#include <limits>

namespace grainbench {

namespace {

/// Key of the chosen alternative of a variant.
template <class Variant>
std::string key_of(const Variant& variant) {
    return std::visit([]<class T>(const T&) { return std::string(T::key); }, variant);
}

std::string at(const std::string& list, std::size_t k) {
    return list + "/" + std::to_string(k);
}

class EffectList {
public:
    explicit EffectList(const Scene& scene) {
        if (scene.gravity) {
            add("gravity", "/gravity");
        }
        if (scene.periodic) {
            add("periodic", "/periodic");
        }
        for (std::size_t w = 0; w < scene.walls.size(); ++w) {
            add_motion(scene.walls[w].motion, at("/walls", w) + "/motion");
        }
        for (std::size_t s = 0; s < scene.particles.sources.size(); ++s) {
            add("source", at("/particles/sources", s));
        }
        for (std::size_t s = 0; s < scene.particles.sinks.size(); ++s) {
            add("sink", at("/particles/sinks", s));
        }
        if (scene.guards.lost.action == LostAction::remove) {
            add("deletion_of_lost", "/guards/lost/action");
        }
        for (std::size_t d = 0; d < scene.driven.size(); ++d) {
            add("driven_group", at("/driven", d));
        }
        if (scene.local_damping) {
            add("local_damping", "/local_damping");
        }
        add_contact(scene.contact, "/contact");
        add(key_of(scene.timestep) + "_timestep", "/timestep");
        add(key_of(scene.detection.trigger) + "_trigger", "/detection/trigger");
        if (scene.detection.create_on_overlap) {
            add("create_on_overlap", "/detection/create_on_overlap");
        }
        for (std::size_t s = 0; s < scene.stages.size(); ++s) {
            add_stage(scene.stages[s], at("/stages", s));
        }
        add_measurements(scene);
    }

    std::vector<Effect> take() && { return std::move(effects_); }

private:
    void add(std::string name, std::string pointer) {
        effects_.push_back({std::move(name), std::move(pointer)});
    }

    void add_motion(const WallMotion& motion, const std::string& pointer) {
        if (!std::holds_alternative<FixedMotion>(motion)) {
            add(key_of(motion), pointer);
        }
    }

    void add_contact(const Contact& contact, const std::string& pointer) {
        add(key_of(contact.stiffness), pointer + "/stiffness");
        add(key_of(contact.normal), pointer + "/normal");
        if (contact.friction) {
            add(key_of(*contact.friction), pointer + "/friction");
        }
        if (contact.damping) {
            add(key_of(*contact.damping), pointer + "/damping");
        }
        if (contact.cohesion) {
            add(key_of(*contact.cohesion), pointer + "/cohesion");
        }
        if (contact.rolling) {
            add(key_of(*contact.rolling), pointer + "/rolling");
        }
        if (contact.twisting) {
            add(key_of(*contact.twisting), pointer + "/twisting");
        }
        if (contact.lever_arm == LeverArm::radius) {
            add("lever_of_the_radius", pointer + "/lever_arm");
        }
    }

    void add_stage(const Stage& stage, const std::string& pointer) {
        for (std::size_t m = 0; m < stage.motions.size(); ++m) {
            add_motion(stage.motions[m].motion, at(pointer + "/motions", m) + "/motion");
        }
        if (stage.gravity) {
            add("gravity", pointer + "/gravity");
        }
        for (std::size_t d = 0; d < stage.driven.size(); ++d) {
            add("driven_group", at(pointer + "/driven", d));
        }
        if (stage.local_damping) {
            add("local_damping", pointer + "/local_damping");
        }
        if (stage.contact) {
            add_contact(*stage.contact, pointer + "/contact");
        }
        if (stage.timestep) {
            add(key_of(*stage.timestep) + "_timestep", pointer + "/timestep");
        }
        if (stage.output && stage.output->contacts) {
            add("contact_network", pointer + "/output/contacts");
        }
        if (stage.output && stage.output->orientation) {
            add("orientation", pointer + "/output/orientation");
        }
    }

    void add_measurements(const Scene& scene) {
        if (scene.observables.elevation) {
            add("elevation", "/observables/elevation");
        }
        if (scene.observables.energy) {
            add("energy", "/observables/energy");
        }
        if (scene.observables.wall_forces) {
            add("wall_forces", "/observables/wall_forces");
        }
        if (scene.observables.coordination) {
            add("coordination", "/observables/coordination");
        }
        if (!scene.observables.regions.empty()) {
            add("regions", "/observables/regions");
        }
        if (scene.observables.mixing) {
            add("mixing", "/observables/mixing");
        }
        if (!scene.observables.repose.empty()) {
            add("repose", "/observables/repose");
        }
        if (scene.observables.coarse_graining) {
            add("coarse_graining", "/observables/coarse_graining");
        }
        if (!scene.traces.empty()) {
            add("traces", "/traces");
        }
        if (scene.output.contacts) {
            add("contact_network", "/output/contacts");
        }
        if (scene.output.orientation) {
            add("orientation", "/output/orientation");
        }
    }

    std::vector<Effect> effects_;
};

bool is_still(const WallMotion& motion) {
    const auto all_zero = [](const std::vector<double>& values) {
        return std::all_of(values.begin(), values.end(), [](double v) { return v == 0.0; });
    };
    return std::visit(Overloaded{[](const FixedMotion&) { return false; },
                                 [](const ConstantMotion& m) { return norm(m.velocity) == 0.0; },
                                 [](const SinusoidMotion& m) { return norm(m.velocity) == 0.0; },
                                 [](const RotationMotion& m) { return m.rate == 0.0; },
                                 [&](const TableMotion& m) { return all_zero(m.speeds); },
                                 [](const SmoothedSquareMotion& m) { return m.amplitude == 0.0; }},
                      motion);
}

bool has_shear_stiffness(const StiffnessLaw& law) {
    return std::visit(
        Overloaded{[](const ConstantStiffness::Params& p) { return p.shear > 0.0; },
                   [](const DeformabilityStiffness::Params& p) { return p.ratio > 0.0; },
                   [](const HertzStiffness::Params&) { return true; }},
        law);
}

class IdleList {
public:
    explicit IdleList(const Scene& scene) {
        if (scene.gravity && norm(*scene.gravity) == 0.0) {
            add("/gravity", "its components are all 0");
        }
        if (scene.local_damping && scene.local_damping->coefficient == 0.0) {
            add("/local_damping", "its coefficient is 0");
        }
        for (std::size_t w = 0; w < scene.walls.size(); ++w) {
            add_motion(scene.walls[w].motion, at("/walls", w) + "/motion");
        }
        add_contact(scene.contact, "/contact");
        double run = 0.0;
        for (std::size_t s = 0; s < scene.stages.size(); ++s) {
            const Stage& stage = scene.stages[s];
            const std::string pointer = at("/stages", s);
            run += stage.duration;
            for (std::size_t m = 0; m < stage.motions.size(); ++m) {
                add_motion(stage.motions[m].motion, at(pointer + "/motions", m) + "/motion");
            }
            if (stage.contact) {
                add_contact(*stage.contact, pointer + "/contact");
            }
            if (stage.output) {
                add_output(*stage.output, pointer + "/output", stage.duration, "stage");
            }
        }
        add_output(scene.output, "/output", run, "run");
        for (std::size_t s = 0; s < scene.particles.sources.size(); ++s) {
            if (scene.particles.sources[s].start >= run) {
                add(at("/particles/sources", s) + "/start", "the run ends before");
            }
        }
        add_observables(scene);
    }

    std::vector<IdleEffect> take() && { return std::move(idle_); }

private:
    void add(std::string pointer, std::string reason) {
        idle_.push_back({std::move(pointer), std::move(reason)});
    }

    void add_motion(const WallMotion& motion, const std::string& pointer) {
        if (is_still(motion)) {
            add(pointer, "the wall never moves: its speed is 0");
        }
    }

    void add_contact(const Contact& contact, const std::string& pointer) {
        if (contact.friction) {
            bool acts = coefficient(*contact.friction) > 0.0;
            bool sheared = has_shear_stiffness(contact.stiffness);
            for (const PairContact& pair : contact.pairs) {
                acts = acts || (pair.friction && coefficient(*pair.friction) > 0.0);
                sheared = sheared || (pair.stiffness && has_shear_stiffness(*pair.stiffness));
            }
            if (!acts) {
                add(pointer + "/friction", "the coefficient is 0");
            } else if (!sheared) {
                add(pointer + "/friction", "there is no shear stiffness for it to limit");
            }
        }
        if (contact.damping) {
            bool acts = damps(*contact.damping);
            for (const PairContact& pair : contact.pairs) {
                acts = acts || (pair.damping && damps(*pair.damping));
            }
            if (!acts) {
                add(pointer + "/damping", "its damping ratios are 0");
            }
        }
        add_idle(contact, contact.rolling, &PairContact::rolling, pointer + "/rolling");
        add_idle(contact, contact.twisting, &PairContact::twisting, pointer + "/twisting");
        add_idle(contact, contact.cohesion, &PairContact::cohesion, pointer + "/cohesion");
        if (contact.lever_arm == LeverArm::radius && !contact.friction && !contact.damping) {
            add(pointer + "/lever_arm", "no force acts along the contact plane");
        }
    }

    /// A law whose strength is 0 in the scene and in all pairs.
    template <class Law>
    void add_idle(const Contact& contact,
                  const std::optional<Law>& law,
                  std::optional<Law> PairContact::*own,
                  const std::string& pointer) {
        const auto acts = [](const std::optional<Law>& one) {
            return one && std::visit([](const auto& p) { return strength(p) > 0.0; }, *one);
        };
        if (law && !acts(law) &&
            std::none_of(contact.pairs.begin(), contact.pairs.end(), [&](const PairContact& pair) {
                return acts(pair.*own);
            })) {
            add(pointer, "its strength is 0");
        }
    }

    static double strength(const LinearCohesion::Params& p) { return p.force; }

    static double strength(const RollingResistance::Params& p) { return p.coefficient; }

    static double strength(const TwistingResistance::Params& p) { return p.coefficient; }

    static double coefficient(const FrictionLaw& law) {
        return std::visit([](const auto& p) { return p.coefficient; }, law);
    }

    static bool damps(const DampingLaw& law) {
        return std::visit(
            Overloaded{
                [](const ViscousDamping::Params& p) { return p.normal > 0.0 || p.shear > 0.0; },
                [](const RestitutionDamping::Params& p) { return p.restitution < 1.0; }},
            law);
    }

    /// Cells too small for what they are to tell.
    void add_observables(const Scene& scene) {
        double smallest = std::numeric_limits<double>::infinity();
        for (const Species& species : scene.particles.species) {
            smallest = std::min(smallest, species.radius);
        }
        if (const auto& mixing = scene.observables.mixing; mixing && mixing->cell < smallest) {
            add("/observables/mixing/cell",
                "cells smaller than a radius hold one particle each, which tells nothing of "
                "mixing");
        }
        const auto& repose = scene.observables.repose;
        for (std::size_t k = 0; k < repose.size(); ++k) {
            if (repose[k].cell < smallest) {
                add(at("/observables/repose", k) + "/cell",
                    "columns thinner than a radius take every particle for one of the surface");
            }
        }
    }

    void add_output(const Output& output,
                    const std::string& pointer,
                    double length,
                    const std::string& of) {
        const auto check = [&](const std::optional<double>& interval, const char* name) {
            if (interval && *interval > length) {
                add(pointer + "/" + name, "the interval is longer than the " + of);
            }
        };
        check(output.frame_interval, "frame_interval");
        check(output.history_interval, "history_interval");
        check(output.trace_interval, "trace_interval");
        check(output.field_interval, "field_interval");
        check(output.checkpoint_interval, "checkpoint_interval");
    }

    std::vector<IdleEffect> idle_;
};

}  // namespace

std::vector<Effect> effects_of(const Scene& scene) {
    return EffectList(scene).take();
}

std::vector<std::string> laws_of(const Contact& contact) {
    std::vector<std::string> laws{key_of(contact.stiffness), key_of(contact.normal)};
    if (contact.friction) {
        laws.push_back(key_of(*contact.friction));
    }
    if (contact.damping) {
        laws.push_back(key_of(*contact.damping));
    }
    if (contact.cohesion) {
        laws.push_back(key_of(*contact.cohesion));
    }
    if (contact.rolling) {
        laws.push_back(key_of(*contact.rolling));
    }
    if (contact.twisting) {
        laws.push_back(key_of(*contact.twisting));
    }
    return laws;
}

double reach_of(const Scene& scene, const Contact& contact) {
    return ContactTable(contact, Materials(scene)).reach();
}

std::vector<IdleEffect> idle_effects(const Scene& scene) {
    return IdleList(scene).take();
}

}  // namespace grainbench
