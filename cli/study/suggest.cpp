#include "cli/study/suggest.hpp"

#include "core/measure/contact_scales.hpp"
#include "core/simulation.hpp"

#include "io/json/scene_json.hpp"
#include "io/text.hpp"

#include "cli/jobs/planned_steps.hpp"
#include "cli/study/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace grainbench::cli {
namespace {

constexpr std::int64_t realisations = 3;

/// What all runs may take together [s of processor time], and what a particle-step usually takes.
constexpr double affordable = 400.0;
constexpr double usual_step_time = 6e-8;

std::string change(const std::string& pointer, double value) {
    return pointer + "=" + io::to_text(value);
}

/// Stiffness of one set of laws times a factor.
void soften(const Contact& contact,
            const std::string& pointer,
            double factor,
            std::vector<std::string>& changes) {
    const auto soften_one = [&](const StiffnessLaw& law, const std::string& at) {
        std::visit(Overloaded{[&](const ConstantStiffness::Params& p) {
                                  changes.push_back(change(at + "/normal", factor * p.normal));
                                  if (p.shear > 0.0) {
                                      changes.push_back(change(at + "/shear", factor * p.shear));
                                  }
                              },
                              [&](const DeformabilityStiffness::Params& p) {
                                  changes.push_back(change(at + "/scale", factor * p.scale));
                              },
                              [&](const HertzStiffness::Params& p) {
                                  changes.push_back(
                                      change(at + "/young_modulus", factor * p.young_modulus));
                                  for (std::size_t m = 0; m < p.materials.size(); ++m) {
                                      changes.push_back(change(
                                          fmt::format("{}/materials/{}/young_modulus", at, m),
                                          factor * p.materials[m].young_modulus));
                                  }
                              }},
                   law);
    };
    soften_one(contact.stiffness, pointer + "/stiffness");
    for (std::size_t k = 0; k < contact.pairs.size(); ++k) {
        if (contact.pairs[k].stiffness) {
            soften_one(*contact.pairs[k].stiffness,
                       fmt::format("{}/pairs/{}/stiffness", pointer, k));
        }
    }
}

io::StudyVariant softer(const Scene& scene, double factor) {
    io::StudyVariant variant{.name = fmt::format("stiffness x {}", factor)};
    soften(scene.contact, "/contact", factor, variant.set);
    for (std::size_t s = 0; s < scene.stages.size(); ++s) {
        if (scene.stages[s].contact) {
            soften(*scene.stages[s].contact,
                   fmt::format("/stages/{}/contact", s),
                   factor,
                   variant.set);
        }
    }
    return variant;
}

/// Replaces the scheme of the scene and of its stages.
io::StudyVariant with_step(const Scene& scene, std::string name, const std::string& scheme) {
    io::StudyVariant variant{.name = std::move(name), .set = {"/timestep=" + scheme}};
    for (std::size_t s = 0; s < scene.stages.size(); ++s) {
        if (scene.stages[s].timestep) {
            variant.set.push_back(fmt::format("/stages/{}/timestep={}", s, scheme));
        }
    }
    return variant;
}

std::string fixed_step(double value) {
    return fmt::format(R"({{"type":"fixed","value":{}}})", io::to_text(value));
}

std::vector<io::StudyVariant> step_variants(const Scene& scene) {
    const double limit =
        contact_scales(scene, scene.contact, one_particle_of_each(scene)).limit.timestep;
    if (const auto* automatic = std::get_if<AutomaticTimestep>(&scene.timestep)) {
        const double planned = automatic->safety_factor * limit;
        std::vector<io::StudyVariant> variants{
            with_step(scene, "safety factor 1", R"({"type":"automatic","safety_factor":1})")};
        for (const double factor : {1.0, 1.5}) {
            // Two digits are what somebody would write.
            const double step = std::stod(fmt::format("{:.1e}", factor * planned));
            variants.push_back(
                with_step(scene, fmt::format("fixed {:.1e} s", step), fixed_step(step)));
        }
        return variants;
    }
    if (const auto* fixed = std::get_if<FixedTimestep>(&scene.timestep)) {
        return {with_step(scene, "automatic step", R"({"type":"automatic"})"),
                with_step(scene, "half the step", fixed_step(0.5 * fixed->value)),
                with_step(scene, "twice the step", fixed_step(2.0 * fixed->value))};
    }
    return {};  // the step of a scaled scene has no meaning
}

std::vector<io::StudyVariant> detection_variants(const Scene& scene) {
    std::vector<io::StudyVariant> variants;
    if (std::holds_alternative<DisplacementTrigger>(scene.detection.trigger)) {
        variants.push_back({.name = "search every 10 cycles",
                            .set = {R"(/detection/trigger={"type":"interval","cycles":10})"}});
    }
    if (!scene.detection.create_on_overlap) {
        variants.push_back(
            {.name = "contacts on overlap", .set = {"/detection/create_on_overlap=true"}});
    }
    return variants;
}

struct Extent {
    double low = 0.0;
    double high = 0.0;
    double smallest_radius = 0.0;
    double particles = 0.0;
};

/// Along z, of the first realisation at its start.
Extent extent_of(const Scene& scene) {
    const ParticleFrame frame = Simulation(scene, 0).particle_frame();
    Extent extent{.low = 0.0, .high = 1.0, .smallest_radius = 1.0};
    for (std::size_t k = 0; k < frame.size(); ++k) {
        const double r = frame.radius[k];
        const double z = frame.position[k].z;
        extent.low = k == 0 ? z - r : std::min(extent.low, z - r);
        extent.high = k == 0 ? z + r : std::max(extent.high, z + r);
        extent.smallest_radius = k == 0 ? r : std::min(extent.smallest_radius, r);
    }
    extent.particles = static_cast<double>(frame.size());
    return extent;
}

/// Cuts all stages at the time that is affordable.
std::vector<std::string> cuts(const Scene& scene, double duration) {
    std::vector<std::string> changes;
    double begin = 0.0;
    for (std::size_t s = 0; s < scene.stages.size(); ++s) {
        const double kept = std::clamp(duration - begin, 0.0, scene.stages[s].duration);
        begin += scene.stages[s].duration;
        if (kept < scene.stages[s].duration) {
            changes.push_back(change(fmt::format("/stages/{}/duration", s), kept));
        }
    }
    return changes;
}

}  // namespace

io::Study suggested_study(const std::filesystem::path& scene_file) {
    const Scene scene = io::read_scene(scene_file);
    const Extent extent = extent_of(scene);
    io::Study study;
    study.title = fmt::format("Settings for {}", scene_file.stem().string());
    study.scene = scene_file.is_absolute() ? scene_file.generic_string()
                                           : scene_file.filename().generic_string();
    study.reference = "as it is";
    study.realisations = realisations;
    study.variants = {{.name = study.reference}, softer(scene, 0.1), softer(scene, 0.01)};
    for (const auto& more : {step_variants(scene), detection_variants(scene)}) {
        study.variants.insert(study.variants.end(), more.begin(), more.end());
    }

    const double all_steps = planned_cycles(scene) * extent.particles *
                             static_cast<double>(realisations * study.variants.size());
    const double whole = duration_of(scene);
    const double share = std::min(1.0, affordable / (usual_step_time * std::max(1.0, all_steps)));
    const double duration = share < 1.0 ? std::stod(fmt::format("{:.2g}", share * whole)) : whole;
    study.set = cuts(scene, duration);
    study.set.push_back("/output/frame_interval=null");
    study.set.push_back(change("/output/history_interval", duration / 200.0));

    if (scene.observables.elevation) {
        study.observable = io::ElevationCurve{.points = 10};
        study.margin = extent.smallest_radius;
    } else {
        constexpr int bins = 40;  // so that what has fallen to the ground still fills some of them
        study.observable = io::FinalProfile{
            .axis = io::ProfileAxis::z, .low = extent.low, .high = extent.high, .bins = bins};
        study.margin = 0.02;
    }
    study.description = fmt::format(
        "Softer contacts, longer steps and relaxed detection against the scene as it is, one at a "
        "time, over the first {:.3g} s of {:.3g} s. Made by `grainbench study --suggest`; copy "
        "suggested-study.json, and change what is compared and which difference matters to you.",
        duration,
        whole);
    io::validate_study(study, "suggested study");
    return study;
}

}  // namespace grainbench::cli
