/// Plain description of a run: what the JSON says, with units and defaults, and nothing else. No
/// pointers, no JSON, no behaviour; core/simulation.hpp builds the running state from it. Its parts
/// are in core/scene, by theme. SI units.
#pragma once

#include "core/body/laws/local_damping.hpp"
#include "core/describe.hpp"
#include "core/guards/guards.hpp"
#include "core/scene/contact.hpp"
#include "core/scene/driven.hpp"
#include "core/scene/measurement.hpp"
#include "core/scene/observables.hpp"
#include "core/scene/output.hpp"
#include "core/scene/particles.hpp"
#include "core/scene/periodic.hpp"
#include "core/scene/stages.hpp"
#include "core/scene/stepping.hpp"
#include "core/scene/walls.hpp"
#include "core/types.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace grainbench {

/// Independent copies of the scene that differ in their random numbers.
struct Realisations {
    std::int64_t count = 1;
    std::int64_t seed = 10001;

    static constexpr auto fields() {
        return std::tuple{
            field(&Realisations::count, "count", "1", between(1, 10000), "number of copies"),
            field(&Realisations::seed,
                  "seed",
                  "",
                  at_least(0),
                  "seed of the first; the others count up from it")};
    }
};

struct Scene {
    static constexpr std::string_view format_name = "grainbench-scene/1";

    std::string schema;
    std::string format{format_name};
    std::string title;
    std::string description;
    std::optional<Vec3> gravity;
    std::optional<Periodic> periodic;
    Particles particles;
    std::vector<Wall> walls;
    Contact contact;
    std::optional<LocalDamping> local_damping;
    std::vector<DrivenGroup> driven;
    Timestep timestep;
    Detection detection;
    std::vector<Stage> stages;
    std::vector<Group> groups;
    std::optional<Layers> layers;
    Observables observables;
    std::vector<Trace> traces;
    Realisations realisations;
    Guards guards;
    Output output;

    static constexpr auto fields() {
        return std::tuple{
            field(&Scene::schema, "$schema", "", any_number(), "schema for editors; not read"),
            required(&Scene::format, "format", "", any_number(), "\"grainbench-scene/1\""),
            field(&Scene::title, "title", "", any_number(), "one line"),
            field(&Scene::description, "description", "", any_number(), "what the scene shows"),
            field(&Scene::gravity, "gravity", "m/s^2", any_number(), "acceleration; absent = none"),
            field(&Scene::periodic,
                  "periodic",
                  "",
                  any_number(),
                  "directions in which the scene repeats itself; absent = none"),
            required(&Scene::particles, "particles", "", any_number(), "species and insertion"),
            field(&Scene::walls, "walls", "", any_number(), "rigid bodies of infinite mass"),
            required(&Scene::contact, "contact", "", any_number(), "contact laws"),
            field(&Scene::local_damping,
                  "local_damping",
                  "",
                  any_number(),
                  "damping of every particle against its own motion; absent = none"),
            field(&Scene::driven, "driven", "", any_number(), "groups that move as told"),
            field(&Scene::timestep, "timestep", "", any_number(), "how the step is chosen"),
            field(&Scene::detection, "detection", "", any_number(), "how contacts are found"),
            required(&Scene::stages, "stages", "", any_number(), "what happens, in this order"),
            field(&Scene::groups, "groups", "", any_number(), "named sets of particles"),
            field(&Scene::layers, "layers", "", any_number(), "numbered slices"),
            field(&Scene::observables, "observables", "", any_number(), "what is measured"),
            field(&Scene::traces, "traces", "", any_number(), "particles whose path is recorded"),
            field(
                &Scene::realisations, "realisations", "", any_number(), "copies with other seeds"),
            field(&Scene::guards, "guards", "", any_number(), "what stops a run, or is warned of"),
            field(&Scene::output, "output", "", any_number(), "when files are written")};
    }
};

/// Whether particles may come or go while the scene runs.
inline bool population_changes(const Scene& scene) {
    return !scene.particles.sinks.empty() || !scene.particles.sources.empty() ||
           scene.guards.lost.action == LostAction::remove;
}

}  // namespace grainbench
