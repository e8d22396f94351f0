#include "io/manifest.hpp"

#include "io/text.hpp"

#include <nlohmann/json.hpp>

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
            {"wall_seconds", realisation.wall_seconds},
            {"cpu_seconds", realisation.cpu_seconds},
            {"particle_steps_per_second", realisation.particle_steps_per_second},
            {"insertion", insertion},
            {"summary", json_of(realisation.summary)},
            {"state_hash", to_hex(realisation.state_hash)}};
}

}  // namespace

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

}  // namespace grainbench::io
