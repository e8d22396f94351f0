#include "cli/run_report.hpp"

#include "cli/progress.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <vector>

namespace grainbench::cli {
namespace {

/// What an entry of particles.insertion inserts, for people.
std::string name_of_entry(const Insertion& insertion) {
    return std::visit(Overloaded{[](const RandomInsertion& i) { return i.species; },
                                 [](const LatticeInsertion& i) { return i.species; },
                                 [](const ListInsertion&) { return std::string("listed"); },
                                 [](const FileInsertion& i) { return i.path; }},
                      insertion);
}

/// Mean and, from two values on, standard deviation.
std::string spread_text(const std::vector<double>& values, const char* unit) {
    double mean = 0.0;
    for (const double value : values) {
        mean += value / static_cast<double>(values.size());
    }
    if (values.size() < 2) {
        return fmt::format("{:.4g} {}", mean, unit);
    }
    double squares = 0.0;
    for (const double value : values) {
        squares += (value - mean) * (value - mean);
    }
    const double deviation = std::sqrt(squares / static_cast<double>(values.size() - 1));
    return fmt::format("{:.4g} {} (standard deviation {:.2g}, {} realisations)",
                       mean,
                       unit,
                       deviation,
                       values.size());
}

std::string optional_text(const std::optional<double>& value) {
    return value ? fmt::format("{:.4g}", *value) : "-";
}

std::string realisations_table(const io::Manifest& manifest) {
    std::string text = fmt::format("{:>12} {:>10} {:>10} {:>12} {:>10} {:>10} {:>10} {:>9} {:>8}\n",
                                   "realisation",
                                   "particles",
                                   "cycles",
                                   "mean dt [s]",
                                   "min dt",
                                   "max dt",
                                   "wall [s]",
                                   "M steps/s",
                                   "late");
    for (std::size_t k = 0; k < manifest.realisations.size(); ++k) {
        const io::RealisationManifest& r = manifest.realisations[k];
        text += fmt::format(
            "{:>12} {:>10} {:>10} {:>12.4g} {:>10.3g} {:>10.3g} {:>10.4g} {:>9.1f} {:>8}\n",
            k + 1,
            r.particles,
            r.cycles,
            r.summary.mean_timestep,
            r.summary.smallest_timestep,
            r.summary.largest_timestep,
            r.wall_seconds,
            1e-6 * r.particle_steps_per_second,
            r.summary.late_contacts);
    }
    return text;
}

std::string elevation_text(const io::Manifest& manifest) {
    std::vector<double> elevations;
    std::vector<double> times;
    std::string text;
    for (std::size_t k = 0; k < manifest.realisations.size(); ++k) {
        const Summary& summary = manifest.realisations[k].summary;
        if (!summary.average_elevation && !summary.entrainment_time) {
            continue;
        }
        text += fmt::format("realisation {}: elevation {} m, entrained at {} s\n",
                            k + 1,
                            optional_text(summary.average_elevation),
                            optional_text(summary.entrainment_time));
        if (summary.entrainment_time) {
            times.push_back(*summary.entrainment_time);
            if (summary.average_elevation) {
                elevations.push_back(*summary.average_elevation);
            }
        }
    }
    if (!elevations.empty()) {
        text += "elevation where entrained: " + spread_text(elevations, "m") + "\n";
    }
    if (!times.empty()) {
        text += "entrainment time: " + spread_text(times, "s") + "\n";
    }
    return text;
}

std::string warnings_text(const io::Manifest& manifest) {
    std::string text;
    for (std::size_t k = 0; k < manifest.realisations.size(); ++k) {
        for (const std::string& warning : manifest.realisations[k].summary.warnings) {
            text += fmt::format("warning: realisation {}: {}\n", k + 1, warning);
        }
    }
    return text;
}

}  // namespace

std::string particles_text(const Scene& scene,
                           std::size_t particles,
                           std::span<const InsertionReport> reports) {
    std::string text = fmt::format("{} particles", particles);
    for (std::size_t k = 0; k < reports.size(); ++k) {
        text += fmt::format("{} {} placed {} of {} asked",
                            k == 0 ? ":" : ",",
                            name_of_entry(scene.particles.insertion[k]),
                            reports[k].placed,
                            reports[k].asked);
    }
    return text + (scene.particles.removal.empty() ? "" : ", then slices removed");
}

std::string insertion_text(const Scene& scene, std::span<const Simulation> simulations) {
    std::string text;
    for (const Simulation& simulation : simulations) {
        text += fmt::format(
            "realisation {} (seed {}): {}\n",
            simulation.index() + 1,
            scene.realisations.seed + simulation.index(),
            particles_text(scene, simulation.particle_count(), simulation.insertion_reports()));
    }
    return text;
}

std::string summary_text(const io::Manifest& manifest, double output_share) {
    double particle_steps = 0.0;
    double seconds = 0.0;
    for (const io::RealisationManifest& r : manifest.realisations) {
        particle_steps += r.particle_steps_per_second * r.wall_seconds;
        seconds += r.wall_seconds;
    }
    std::string text = realisations_table(manifest) + elevation_text(manifest);
    text += fmt::format(
        "{} after {} wall time", manifest.outcome, duration_text(manifest.wall_seconds));
    if (seconds > 0.0) {
        text += fmt::format(
            "; {:.1f} M particle-steps/s per thread; output took {:.1f} % of the stepping",
            1e-6 * particle_steps / seconds,
            100.0 * output_share);
    }
    return text + "\n" + warnings_text(manifest);
}

}  // namespace grainbench::cli
