#include "io/manifest.hpp"

#include "core/error.hpp"

#include "io/atomic_file.hpp"
#include "io/text.hpp"

#include <nlohmann/json.hpp>

#include <limits>

namespace grainbench::io {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Summary& summary) {
    Json json{{"time", summary.time},
              {"mean_timestep", summary.mean_timestep},
              {"smallest_timestep", summary.smallest_timestep},
              {"largest_timestep", summary.largest_timestep}};
    if (summary.entrainment_time) {
        json["entrainment_time"] = *summary.entrainment_time;
    }
    if (summary.average_elevation) {
        json["average_elevation"] = *summary.average_elevation;
    }
    json["late_contacts"] = summary.late_contacts;
    json["largest_overlap_ratio"] = summary.largest_overlap_ratio;
    json["searches"] = summary.searches;
    json["candidate_builds"] = summary.candidate_builds;
    json["warnings"] = summary.warnings;
    return json;
}

Json json_of(const RealisationManifest& realisation) {
    Json insertion = Json::array();
    for (const InsertionReport& report : realisation.insertion) {
        insertion.push_back(
            {{"asked", report.asked}, {"placed", report.placed}, {"tries", report.tries}});
    }
    return {{"seed", realisation.seed},
            {"particles", realisation.particles},
            {"cycles", realisation.cycles},
            {"timed_cycles", realisation.timed_cycles},
            {"wall_seconds", realisation.wall_seconds},
            {"cpu_seconds", realisation.cpu_seconds},
            {"particle_steps_per_second", realisation.particle_steps_per_second},
            {"step_time", realisation.step_time()},
            {"insertion", insertion},
            {"summary", json_of(realisation.summary)},
            {"state_hash", to_hex(realisation.state_hash)}};
}

/// JSON has no word for what is not a number, as an unstable run may hold; it becomes null.
double number_at(const Json& json, const char* key) {
    const Json& value = json.at(key);
    return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

Summary summary_of(const Json& json) {
    Summary summary;
    summary.time = number_at(json, "time");
    summary.mean_timestep = number_at(json, "mean_timestep");
    summary.smallest_timestep = number_at(json, "smallest_timestep");
    summary.largest_timestep = number_at(json, "largest_timestep");
    if (json.contains("entrainment_time")) {
        summary.entrainment_time = number_at(json, "entrainment_time");
    }
    if (json.contains("average_elevation")) {
        summary.average_elevation = number_at(json, "average_elevation");
    }
    summary.late_contacts = json.at("late_contacts");
    summary.largest_overlap_ratio = number_at(json, "largest_overlap_ratio");
    summary.searches = json.at("searches");
    summary.candidate_builds = json.at("candidate_builds");
    summary.warnings = json.at("warnings").get<std::vector<std::string>>();
    return summary;
}

RealisationManifest realisation_of(const Json& json) {
    RealisationManifest realisation;
    realisation.seed = json.at("seed");
    realisation.particles = json.at("particles");
    realisation.cycles = json.at("cycles");
    realisation.timed_cycles = json.at("timed_cycles");
    realisation.wall_seconds = number_at(json, "wall_seconds");
    realisation.cpu_seconds = number_at(json, "cpu_seconds");
    realisation.particle_steps_per_second = number_at(json, "particle_steps_per_second");
    for (const Json& report : json.at("insertion")) {
        realisation.insertion.push_back({.asked = report.at("asked"),
                                         .placed = report.at("placed"),
                                         .tries = report.at("tries")});
    }
    realisation.summary = summary_of(json.at("summary"));
    realisation.summary.cycles = realisation.cycles;
    realisation.state_hash = std::stoull(json.at("state_hash").get<std::string>(), nullptr, 16);
    return realisation;
}

Manifest manifest_of(const Json& json) {
    Manifest manifest;
    manifest.version = json.at("version");
    manifest.git_hash = json.at("git_hash");
    manifest.compiler = json.at("compiler");
    manifest.compiler_flags = json.at("compiler_flags");
    manifest.cpu = json.at("cpu");
    manifest.isa = json.at("isa");
    manifest.threads = json.at("threads");
    manifest.outcome = json.at("outcome");
    manifest.message = json.value("message", "");
    manifest.effects = json.at("effects").get<std::vector<std::string>>();
    manifest.wall_seconds = number_at(json, "wall_seconds");
    for (const Json& realisation : json.at("realisations")) {
        manifest.realisations.push_back(realisation_of(realisation));
    }
    return manifest;
}

}  // namespace

double RealisationManifest::step_time() const {
    const double steps = static_cast<double>(timed_cycles) * static_cast<double>(particles);
    return steps > 0.0 ? cpu_seconds / steps : 0.0;
}

std::string to_json(const Manifest& manifest) {
    Json realisations = Json::array();
    for (const RealisationManifest& realisation : manifest.realisations) {
        realisations.push_back(json_of(realisation));
    }
    Json json{{"format", "grainbench-manifest/1"},
              {"version", manifest.version},
              {"git_hash", manifest.git_hash},
              {"compiler", manifest.compiler},
              {"compiler_flags", manifest.compiler_flags},
              {"cpu", manifest.cpu},
              {"isa", manifest.isa},
              {"threads", manifest.threads},
              {"outcome", manifest.outcome}};
    if (!manifest.message.empty()) {
        json["message"] = manifest.message;
    }
    json["effects"] = manifest.effects;
    json["wall_seconds"] = manifest.wall_seconds;
    json["realisations"] = realisations;
    // Names of processors and errors of the system may hold bytes that are not UTF-8.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Manifest read_manifest(const std::filesystem::path& file) {
    const std::string text = read_file(file);
    try {
        return manifest_of(Json::parse(text));
    } catch (const std::exception& error) {
        throw_input_output({.what = std::string("the manifest cannot be read: ") + error.what(),
                            .where = file.string(),
                            .likely_cause = "damaged, or written by another version of grainbench",
                            .next_step = "remove the file, or run the scene into a new folder"});
    }
}

}  // namespace grainbench::io
