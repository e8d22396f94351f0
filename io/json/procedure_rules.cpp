#include "core/effects.hpp"
#include "core/scene.hpp"

#include "io/json/scene_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace grainbench::io {

namespace {

/// Species, then the wall materials that are none.
std::vector<std::string_view> materials_of(const Scene& scene) {
    std::vector<std::string_view> known = names_of(scene.particles.species);
    for (const Wall& wall : scene.walls) {
        if (std::find(known.begin(), known.end(), wall.material_name()) == known.end()) {
            known.push_back(wall.material_name());
        }
    }
    return known;
}

void add(Problems& problems,
         std::string pointer,
         std::string what,
         std::string likely_cause,
         std::string next_step) {
    problems.add(
        {std::move(pointer), std::move(what), std::move(likely_cause), std::move(next_step)});
}

bool has_shear_stiffness(const StiffnessLaw& law) {
    return std::visit(
        Overloaded{[](const ConstantStiffness::Params& p) { return p.shear > 0.0; },
                   [](const DeformabilityStiffness::Params& p) { return p.ratio > 0.0; },
                   [](const HertzStiffness::Params&) { return true; }},
        law);
}

bool has_friction(const FrictionLaw& law) {
    return std::visit([](const auto& p) { return p.coefficient > 0.0; }, law);
}

/// Friction needs a shear spring: without one it would do nothing, silently.
void check_shear(const StiffnessLaw& stiffness,
                 const std::optional<FrictionLaw>& friction,
                 const std::string& pointer,
                 Problems& problems) {
    if (friction && has_friction(*friction) && !has_shear_stiffness(stiffness)) {
        add(problems,
            pointer,
            "friction is on, but the shear stiffness is 0",
            "'shear' (or 'ratio') is left out or 0",
            "give a shear stiffness, or remove friction");
    }
}

template <class Law>
std::string key_of(const Law& law) {
    return std::visit([]<class A>(const A&) { return std::string(A::key); }, law);
}

/// Cohesion acts between contact objects, which exist within the detection tolerance.
void check_reach(const Scene& scene,
                 const Contact& contact,
                 const std::string& pointer,
                 Problems& problems) {
    const bool is_jkr = std::holds_alternative<JkrAdhesion::Params>(contact.normal);
    if ((!is_jkr && !contact.cohesion) || scene.particles.species.empty()) {
        return;
    }
    const std::string key = pointer + (is_jkr ? "/normal" : "/cohesion");
    if (scene.detection.create_on_overlap) {
        add(problems,
            key,
            "cohesion acts over a gap, but contacts exist only while surfaces overlap",
            "detection/create_on_overlap is on",
            "remove create_on_overlap");
    }
    double smallest = scene.particles.species.front().radius;
    for (const Species& species : scene.particles.species) {
        smallest = std::min(smallest, species.radius);
    }
    const double reach = reach_of(scene, contact);
    const double tolerance = scene.detection.tolerance * smallest;
    if (reach > tolerance) {
        add(problems,
            key,
            fmt::format("it reaches over {:.3g} m, detection over {:.3g} m", reach, tolerance),
            "contacts are looked for within the tolerance times the radius",
            fmt::format("give a detection/tolerance above {:.3g}", reach / smallest));
    }
}

/// Hertz's stiffness goes with Hertz's spring and a friction that follows its area; constant ones
/// with linear springs.
void check_law_family(const Contact& contact, const std::string& pointer, Problems& problems) {
    const bool hertzian = std::holds_alternative<HertzStiffness::Params>(contact.stiffness);
    const bool hertz_spring = std::holds_alternative<HertzSpring::Params>(contact.normal) ||
                              std::holds_alternative<JkrAdhesion::Params>(contact.normal);
    if (hertzian != hertz_spring) {
        add(problems,
            pointer + "/normal",
            fmt::format(
                "'{}' does not go with '{}'", key_of(contact.normal), key_of(contact.stiffness)),
            "linear springs need a constant stiffness, Hertz's spring the elastic constants",
            hertzian ? "use 'hertz_spring' or 'jkr_adhesion', or another stiffness"
                     : "use 'linear_spring', or 'hertz_stiffness'");
    }
    if (contact.friction &&
        hertzian != std::holds_alternative<MindlinFriction::Params>(*contact.friction)) {
        add(problems,
            pointer + "/friction",
            fmt::format(
                "'{}' does not go with '{}'", key_of(*contact.friction), key_of(contact.stiffness)),
            hertzian ? "a spring whose stiffness changes would give energy"
                     : "the stiffness does not change with the overlap",
            hertzian ? "use 'mindlin_friction'" : "use 'coulomb_friction'");
    }
}

/// What rolling, twisting and cohesion need of the other laws.
void check_further_laws(const Contact& contact, const std::string& pointer, Problems& problems) {
    for (const auto& [is_on, name] : {std::pair{contact.rolling.has_value(), "rolling"},
                                      std::pair{contact.twisting.has_value(), "twisting"}}) {
        if (is_on && !contact.friction) {
            add(problems,
                fmt::format("{}/{}", pointer, name),
                fmt::format("{} resistance without friction", name),
                "a frictionless sphere slides, it does not roll",
                "add friction, or remove this key");
        }
    }
    if (contact.cohesion && !std::holds_alternative<LinearSpring::Params>(contact.normal) &&
        !std::holds_alternative<HertzSpring::Params>(contact.normal)) {
        add(problems,
            pointer + "/cohesion",
            fmt::format("cohesion does not go with '{}'", key_of(contact.normal)),
            "over the gap the spring must vanish by itself",
            "use 'linear_spring' or 'hertz_spring'");
    }
    if (std::holds_alternative<WaltonBraunSpring::Params>(contact.normal) && contact.damping &&
        std::holds_alternative<RestitutionDamping::Params>(*contact.damping)) {
        add(problems,
            pointer + "/damping",
            "'restitution_damping' on a spring that has a restitution of its own",
            "the two losses would add up to another restitution",
            "remove one of them");
    }
}

/// Materials with elastic constants of their own must exist, each once.
void check_elastic_materials(const Scene& scene,
                             const StiffnessLaw& law,
                             const std::string& pointer,
                             Problems& problems) {
    const auto* hertz = std::get_if<HertzStiffness::Params>(&law);
    if (hertz == nullptr) {
        return;
    }
    check_unique_names(names_of(hertz->materials), pointer + "/materials", problems);
    for (std::size_t m = 0; m < hertz->materials.size(); ++m) {
        check_known(hertz->materials[m].name,
                    materials_of(scene),
                    "material",
                    fmt::format("{}/materials/{}/name", pointer, m),
                    problems);
    }
}

/// A pair's law must be on in the scene, and be the same law.
template <class Law>
void check_pair_law(const std::optional<Law>& of_pair,
                    const Law* of_scene,
                    const std::string& pointer,
                    Problems& problems) {
    if (!of_pair) {
        return;
    }
    if (of_scene == nullptr) {
        add(problems,
            pointer,
            fmt::format("'{}' is off in the scene", key_of(*of_pair)),
            "a pair changes numbers of a law, it cannot turn one on",
            "turn the law on for all contacts, with a number that does nothing there");
    } else if (of_pair->index() != of_scene->index()) {
        add(problems,
            pointer,
            fmt::format("'{}' here, but '{}' in the scene", key_of(*of_pair), key_of(*of_scene)),
            "a pair changes numbers of a law, not the law",
            fmt::format("use '{}' in the pair too", key_of(*of_scene)));
    }
}

template <class Law>
const Law* pointer_to(const std::optional<Law>& law) {
    return law ? &*law : nullptr;
}

/// Checks the names of one pair; false if they are not two known ones.
bool check_pair_names(const Scene& scene,
                      const PairContact& pair,
                      const std::string& at,
                      Problems& problems) {
    if (pair.between.size() != 2) {
        add(problems,
            at + "/between",
            fmt::format("{} names; expected 2", pair.between.size()),
            "a pair has two sides",
            "give two names; the same twice for a species with itself");
        return false;
    }
    const auto species = names_of(scene.particles.species);
    const auto known = materials_of(scene);
    const std::size_t before = problems.size();
    check_known(pair.between[0], known, "material", at + "/between/0", problems);
    check_known(pair.between[1], known, "material", at + "/between/1", problems);
    if (problems.size() > before) {
        return false;
    }
    const auto is_species = [&](const std::string& name) {
        return std::find(species.begin(), species.end(), name) != species.end();
    };
    if (!is_species(pair.between[0]) && !is_species(pair.between[1])) {
        add(problems,
            at + "/between",
            "a pair of two walls",
            "walls do not touch each other",
            "name a species on one side");
    }
    return true;
}

void check_groups(const Scene& scene, Problems& problems) {
    check_unique_names(names_of(scene.groups), "/groups", problems);
    for (std::size_t i = 0; i < scene.groups.size(); ++i) {
        const Group& group = scene.groups[i];
        const std::string at = fmt::format("/groups/{}", i);
        if (group.species) {
            check_known(*group.species,
                        names_of(scene.particles.species),
                        "species",
                        at + "/species",
                        problems);
        }
        if (group.box) {
            check_box(group.box->low, group.box->high, at + "/box", problems);
        }
    }
}

void check_layers(const Layers& layers, Problems& problems) {
    const auto& edges = layers.edges;
    if (edges.size() < 2) {
        add(problems,
            "/layers/edges",
            fmt::format("{} edges; expected at least 2", edges.size()),
            "a layer lies between two edges",
            "add edges, or remove 'layers'");
        return;
    }
    const bool descending = edges[1] < edges[0];
    for (std::size_t i = 1; i < edges.size(); ++i) {
        if (!(descending ? edges[i] < edges[i - 1] : edges[i] > edges[i - 1])) {
            add(problems,
                fmt::format("/layers/edges/{}", i),
                fmt::format("{} m after {} m: edges neither all descend nor all ascend",
                            edges[i],
                            edges[i - 1]),
                "two edges are swapped or equal",
                "sort the edges");
            return;
        }
    }
}

void check_output(const Scene& scene,
                  const Output& output,
                  const std::string& pointer,
                  Problems& problems) {
    if (output.field_interval && !scene.observables.coarse_graining) {
        add(problems,
            pointer + "/field_interval",
            "there are no fields to write",
            "'observables' has no 'coarse_graining'",
            "add observables/coarse_graining, or remove this key");
    }
    if (output.history_interval && output.history_cycles) {
        add(problems,
            pointer + "/history_cycles",
            "both history_interval and history_cycles",
            "one of them may come from an extended scene",
            "keep one; null removes the other");
    }
}

void check_traces(const Scene& scene, Problems& problems) {
    for (std::size_t i = 0; i < scene.traces.size(); ++i) {
        if (const auto& species = scene.traces[i].species) {
            check_known(*species,
                        names_of(scene.particles.species),
                        "species",
                        fmt::format("/traces/{}/species", i),
                        problems);
        }
    }
}

void check_driven(const Scene& scene,
                  const std::vector<DrivenGroup>& driven,
                  const std::string& pointer,
                  Problems& problems) {
    std::set<std::string_view> seen;
    for (std::size_t i = 0; i < driven.size(); ++i) {
        const std::string at = fmt::format("{}/{}", pointer, i);
        const std::string& name = driven[i].group;
        check_known(name, names_of(scene.groups), "group", at + "/group", problems);
        check_motion(driven[i].motion, at + "/motion", problems);
        if (!seen.insert(name).second) {
            add(problems,
                at + "/group",
                fmt::format("a second motion for '{}'", name),
                "an entry was copied and not renamed",
                "keep one motion for each group");
        }
        const auto walls = names_of(scene.walls);
        if (std::find(walls.begin(), walls.end(), name) != walls.end()) {
            add(problems,
                at + "/group",
                fmt::format("'{}' is also the name of a wall", name),
                "forces on both would have one name in the history",
                "rename the group or the wall");
        }
    }
}

/// Only what is driven can be released.
void check_all_driven(const Scene& scene, Problems& problems) {
    std::set<std::string_view> driven;
    const auto add_names = [&](const std::vector<DrivenGroup>& groups) {
        for (const DrivenGroup& group : groups) {
            driven.insert(group.group);
        }
    };
    check_driven(scene, scene.driven, "/driven", problems);
    add_names(scene.driven);
    for (std::size_t s = 0; s < scene.stages.size(); ++s) {
        const Stage& stage = scene.stages[s];
        const std::string at = fmt::format("/stages/{}", s);
        for (std::size_t r = 0; r < stage.released.size(); ++r) {
            if (driven.erase(stage.released[r]) == 0) {
                add(problems,
                    fmt::format("{}/released/{}", at, r),
                    fmt::format("the group '{}' is not driven", stage.released[r]),
                    "it was released before, or the name is misspelt",
                    "name a group that is driven up to this stage");
            }
        }
        check_driven(scene, stage.driven, at + "/driven", problems);
        add_names(stage.driven);
    }
}

void check_stage(const Scene& scene,
                 const Stage& stage,
                 const std::string& at,
                 Problems& problems) {
    std::set<std::string_view> moved;
    for (std::size_t i = 0; i < stage.motions.size(); ++i) {
        const StageMotion& motion = stage.motions[i];
        const std::string here = fmt::format("{}/motions/{}", at, i);
        check_known(motion.wall, names_of(scene.walls), "wall", here + "/wall", problems);
        if (!moved.insert(motion.wall).second) {
            add(problems,
                here + "/wall",
                fmt::format("a second motion for '{}'", motion.wall),
                "an entry was copied and not renamed",
                "keep one motion for each wall");
        }
        check_motion(motion.motion, here + "/motion", problems);
    }
    if (stage.contact) {
        check_contact(scene, *stage.contact, at + "/contact", problems);
    }
    if (stage.output) {
        check_output(scene, *stage.output, at + "/output", problems);
    }
    if (stage.average_interval && !scene.observables.elevation) {
        add(problems,
            at + "/average_interval",
            "there is no elevation to average",
            "'observables' has no 'elevation'",
            "add observables/elevation, or remove this key");
    }
}

}  // namespace

void check_contact(const Scene& scene,
                   const Contact& contact,
                   const std::string& pointer,
                   Problems& problems) {
    const std::size_t before = problems.size();
    check_law_family(contact, pointer, problems);
    check_further_laws(contact, pointer, problems);
    check_shear(contact.stiffness, contact.friction, pointer + "/stiffness", problems);
    check_elastic_materials(scene, contact.stiffness, pointer + "/stiffness", problems);
    std::set<std::pair<std::string, std::string>> seen;
    for (std::size_t i = 0; i < contact.pairs.size(); ++i) {
        const PairContact& pair = contact.pairs[i];
        const std::string at = fmt::format("{}/pairs/{}", pointer, i);
        if (check_pair_names(scene, pair, at, problems)) {
            const auto [first, second] = std::minmax(pair.between[0], pair.between[1]);
            if (!seen.emplace(first, second).second) {
                add(problems,
                    at + "/between",
                    fmt::format("the pair '{}', '{}' stands twice", first, second),
                    "the order of the names does not matter",
                    "put all its numbers in one entry");
            }
        }
        if (!pair.stiffness && !pair.normal && !pair.friction && !pair.damping && !pair.cohesion &&
            !pair.rolling && !pair.twisting) {
            add(problems,
                at,
                "the pair changes nothing",
                "no law is given for it",
                "add a law with other numbers, or remove the pair");
        }
        check_pair_law(pair.stiffness, &contact.stiffness, at + "/stiffness", problems);
        if (pair.stiffness) {
            check_elastic_materials(scene, *pair.stiffness, at + "/stiffness", problems);
        }
        check_pair_law(pair.friction, pointer_to(contact.friction), at + "/friction", problems);
        check_pair_law(pair.damping, pointer_to(contact.damping), at + "/damping", problems);
        check_pair_law(pair.normal, &contact.normal, at + "/normal", problems);
        check_pair_law(pair.cohesion, pointer_to(contact.cohesion), at + "/cohesion", problems);
        check_pair_law(pair.rolling, pointer_to(contact.rolling), at + "/rolling", problems);
        check_pair_law(pair.twisting, pointer_to(contact.twisting), at + "/twisting", problems);
        if (contact.friction && (pair.stiffness || pair.friction)) {
            check_shear(pair.stiffness.value_or(contact.stiffness),
                        pair.friction ? pair.friction : contact.friction,
                        pair.stiffness ? at + "/stiffness" : at + "/friction",
                        problems);
        }
    }
    if (problems.size() == before) {
        check_reach(scene, contact, pointer, problems);
    }
}

void check_procedure(const Scene& scene, Problems& problems) {
    if (scene.format != Scene::format_name) {
        add(problems,
            "/format",
            fmt::format("'{}' is not '{}'", scene.format, Scene::format_name),
            "a file of another kind or version",
            "check that this is a scene of this version");
    }
    if (scene.stages.empty()) {
        add(problems, "/stages", "no stages", "the list is empty", "add a stage with its duration");
    }
    for (std::size_t i = 0; i < scene.stages.size(); ++i) {
        check_stage(scene, scene.stages[i], fmt::format("/stages/{}", i), problems);
    }
    check_groups(scene, problems);
    check_all_driven(scene, problems);
    if (scene.layers) {
        check_layers(*scene.layers, problems);
    }
    check_observables(scene, problems);
    check_traces(scene, problems);
    if (const auto& domain = scene.guards.lost.domain) {
        check_box(domain->low, domain->high, "/guards/lost/domain", problems);
    }
    check_output(scene, scene.output, "/output", problems);
}

}  // namespace grainbench::io
