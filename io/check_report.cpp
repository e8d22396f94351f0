#include "io/check_report.hpp"

#include <nlohmann/json.hpp>

#include <map>

namespace grainbench::io {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const ContactTime& time) {
    return {{"first", time.first},
            {"second", time.second},
            {"stiffness", time.stiffness},
            {"effective_mass", time.mass},
            {"duration", time.duration}};
}

Json json_of(const SingleContactLimit& limit) {
    return {{"timestep", limit.timestep},
            {"species", limit.species},
            {"partner", limit.partner},
            {"mass", limit.mass},
            {"radius", limit.radius},
            {"stiffness_n", limit.stiffness_n},
            {"stiffness_s", limit.stiffness_s},
            {"rotation_rules", limit.rotation_rules}};
}

Json json_of(const StageCheck& stage) {
    Json times = Json::array();
    for (const ContactTime& time : stage.scales.times) {
        times.push_back(json_of(time));
    }
    Json json{{"name", stage.name},
              {"duration", stage.duration},
              {"laws", stage.laws},
              {"history_per_contact", stage.scales.history_size},
              {"history_bytes_per_contact", stage.scales.history_bytes},
              {"pass", stage.scales.has_own_pass ? "own" : "general"},
              {"cohesion_reach", stage.scales.reach},
              {"timestep_scheme", stage.scheme},
              {"planned_timestep", stage.planned_timestep},
              {"single_contact_limit", nullptr},
              {"contact_times", times},
              {"steps_per_contact", nullptr},
              {"expected_cycles", stage.expected_cycles}};
    if (!times.empty()) {
        json["single_contact_limit"] = json_of(stage.scales.limit);
    }
    if (stage.steps_per_contact) {
        json["steps_per_contact"] = *stage.steps_per_contact;
    }
    if (stage.softening) {
        json["softening"] = {{"speed", stage.softening->speed},
                             {"overlap_ratio", stage.softening->overlap_ratio},
                             {"pair", {stage.softening->first, stage.softening->second}},
                             {"stiffness_factor", stage.softening->factor},
                             {"speed_up", stage.softening->speed_up}};
    }
    return json;
}

Json json_of(const DetectionCheck& detection) {
    Json json{{"trigger", detection.trigger},
              {"tolerance", detection.tolerance},
              {"fastest_now", detection.fastest_now}};
    if (detection.surest_approach) {
        json["surest_approach"] = *detection.surest_approach;
    }
    return json;
}

}  // namespace

std::string to_json(const CheckReport& report, const std::string& effective_scene) {
    Json effects = Json::array();
    for (const Effect& effect : report.effects) {
        effects.push_back({{"name", effect.name}, {"pointer", effect.pointer}});
    }
    Json insertion = Json::array();
    for (const InsertionReport& entry : report.insertion) {
        insertion.push_back(
            {{"asked", entry.asked}, {"placed", entry.placed}, {"tries", entry.tries}});
    }
    Json stages = Json::array();
    for (const StageCheck& stage : report.stages) {
        stages.push_back(json_of(stage));
    }
    const Json json{{"format", "grainbench-check/1"},
                    {"effects", effects},
                    {"warnings", report.warnings},
                    {"realisations", report.realisations},
                    {"particles", report.particles},
                    {"insertion", insertion},
                    {"stages", stages},
                    {"detection", json_of(report.detection)},
                    {"trial",
                     {{"wall_seconds", report.trial.wall_seconds},
                      {"cycles", report.trial.cycles},
                      {"particle_steps_per_second", report.trial.particle_steps_per_second},
                      {"timestep", report.trial.timestep},
                      {"shares",
                       Json(std::map<std::string, double>(report.trial.shares.begin(),
                                                          report.trial.shares.end()))}}},
                    {"memory_bytes", report.memory_bytes},
                    {"threads", report.threads},
                    {"expected_seconds", report.expected_seconds},
                    {"scene", Json::parse(effective_scene)}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace grainbench::io
