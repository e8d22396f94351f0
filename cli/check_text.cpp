#include "core/simulation.hpp"

#include "cli/check_report.hpp"
#include "cli/progress.hpp"
#include "cli/run_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace grainbench::cli {
namespace {

/// Softer contacts are proposed from here on; less is not worth a study.
constexpr double worthwhile_speed_up = 1.25;

std::string softening_text(const Softening& softening) {
    std::string text =
        fmt::format("  softness  overlaps up to {:.2g} % of the radius, {} with {} at {:.2g} m/s",
                    100.0 * softening.overlap_ratio,
                    softening.first,
                    softening.second,
                    softening.speed);
    if (softening.speed_up >= worthwhile_speed_up) {
        text += fmt::format(
            "; {:.2g} times the stiffness makes it {:.2g} %, with steps {:.2g} "
            "times as long: `grainbench study --suggest` shows whether the result "
            "stays",
            softening.factor,
            100.0 * harmless_overlap,
            softening.speed_up);
    }
    return text + "\n";
}

std::string stage_text(const io::StageCheck& stage, std::size_t number) {
    std::string text = fmt::format("stage {} {}: {:.4g} s, about {:.3g} cycles\n",
                                   number,
                                   stage.name,
                                   stage.duration,
                                   stage.expected_cycles);
    text += fmt::format("  laws      {}; {} numbers of history per contact, {} bytes; {}\n",
                        fmt::join(stage.laws, ", "),
                        stage.scales.history_size,
                        stage.scales.history_bytes,
                        stage.scales.has_own_pass ? "a pass of their own" : "the general pass");
    if (stage.scales.reach > 0.0) {
        text += fmt::format("  cohesion  reaches over {:.3g} m\n", stage.scales.reach);
    }
    if (stage.scales.stiffens) {
        text += fmt::format("  impacts   stiffnesses are those of an impact at {:.3g} m/s\n",
                            stage.scales.impact_speed);
    }
    if (stage.scales.times.empty()) {
        return text;
    }
    const SingleContactLimit& limit = stage.scales.limit;
    text += fmt::format("  timestep  {}, {}{:.3g} s\n",
                        stage.scheme,
                        stage.scheme == AutomaticTimestep::key ? "at most " : "",
                        stage.planned_timestep);
    text += fmt::format(
        "  limit     {:.3g} s for a single contact, {} on {}: {} with m {:.3e} kg, R {:.3g} m, "
        "k_n {:.3g} N/m, k_s {:.3g} N/m (damping counted in)\n",
        limit.timestep,
        limit.species,
        limit.partner,
        limit.rotation_rules ? "sqrt(I / (k_s R^2))" : "sqrt(m / k_n)",
        limit.mass,
        limit.radius,
        limit.stiffness_n,
        limit.stiffness_s);
    const ContactTime& shortest = stage.scales.times.front();
    text += fmt::format(
        "  contact   {:.3g} s at least, {} with {}: {} with m_c {:.3e} kg, k_n {:.3g} N/m",
        shortest.duration,
        shortest.first,
        shortest.second,
        stage.scales.stiffens ? "4.03 sqrt(m_c / k_n)" : "pi sqrt(m_c / k_n)",
        shortest.mass,
        shortest.stiffness);
    if (stage.steps_per_contact) {
        text += fmt::format("; {:.1f} steps", *stage.steps_per_contact);
    }
    text += "\n";
    if (stage.softening) {
        text += softening_text(*stage.softening);
    }
    return text;
}

std::string detection_text(const io::DetectionCheck& detection) {
    std::string text =
        fmt::format("detection: {}; tolerance {:.3g} m", detection.trigger, detection.tolerance);
    if (detection.surest_approach) {
        text += fmt::format("; approaches up to {:.3g} m/s are found in time, {:.3g} m/s occurs",
                            *detection.surest_approach,
                            detection.fastest_now);
    }
    return text + "\n";
}

}  // namespace

std::string check_text(const Scene& scene, const io::CheckReport& report) {
    std::string text = scene.title.empty() ? "" : scene.title + "\n";
    text += "effects on:\n";
    for (const Effect& effect : report.effects) {
        text += fmt::format("  {:<24} {}\n", effect.name, effect.pointer);
    }
    text += fmt::format("realisation 1 of {} (seed {}): {}\n",
                        report.realisations,
                        scene.realisations.seed,
                        particles_text(scene, report.particles, report.insertion));
    for (std::size_t s = 0; s < report.stages.size(); ++s) {
        text += stage_text(report.stages[s], s + 1);
    }
    text += detection_text(report.detection);
    text +=
        fmt::format("trial: {:.1f} M particle-steps/s on one thread, from {} cycles in {:.2g} s\n",
                    1e-6 * report.trial.particle_steps_per_second,
                    report.trial.cycles,
                    report.trial.wall_seconds);
    if (!report.trial.shares.empty()) {
        text += "shares:";
        for (const auto& [phase, share] : report.trial.shares) {
            text += fmt::format(" {} {:.0f} %{}",
                                phase,
                                100.0 * share,
                                phase == report.trial.shares.back().first ? "\n" : ",");
        }
    }
    text += fmt::format("memory: about {:.0f} MB\n", std::ceil(1e-6 * report.memory_bytes));
    text += fmt::format("time: about {} on {} threads, if it goes on as in the trial\n",
                        duration_text(report.expected_seconds),
                        report.threads);
    for (const std::string& warning : report.warnings) {
        text += "warning: " + warning + "\n";
    }
    return text;
}

}  // namespace grainbench::cli
