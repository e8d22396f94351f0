#include "cli/check_report.hpp"

#include "core/measure/openings.hpp"
#include "core/measure/softening.hpp"
#include "core/simulation.hpp"

#include "cli/jobs/planned_steps.hpp"
#include "cli/phase_clock.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <limits>
#include <numeric>
#include <thread>

namespace grainbench::cli {
namespace {

/// Below this, a collision is too coarse for its restitution and duration to be those of the law
/// (physics: at 7 steps a damping ratio of 0.02 gives 0.935 for 0.940; at 15, 0.938).
constexpr double fewest_good_steps = 15.0;

using Clock = std::chrono::steady_clock;

/// Memory of this process in main memory [bytes]; 0 where the system does not tell.
double resident_bytes() {
    std::ifstream statm("/proc/self/statm");
    double all = 0.0;
    double resident = 0.0;
    statm >> all >> resident;
    return statm ? resident * static_cast<double>(sysconf(_SC_PAGESIZE)) : 0.0;
}

double archive_bytes(const Simulation& simulation) {
    Archive archive;
    simulation.save(archive);
    double bytes = 0.0;
    for (const auto& [name, column] : archive.columns()) {
        bytes += std::visit(
            [](const auto& values) {
                return static_cast<double>(values.size() * sizeof(values[0]));
            },
            column);
    }
    return bytes;
}

/// Steps on with a clock in the cycle, which costs a few percent and so was not in the trial.
void measure_shares(Simulation& simulation, double seconds, io::TrialRun& trial) {
    Observer nobody;
    PhaseClock clock;
    simulation.watch_phases(&clock);
    double all = 0.0;
    try {
        for (bool finished = false; !finished && all < seconds;) {
            finished = simulation.advance(10, nobody);
            clock.stop();
            all = std::accumulate(clock.seconds().begin(), clock.seconds().end(), 0.0);
        }
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::unstable) {
            throw;
        }
    }
    simulation.watch_phases(nullptr);
    for (std::size_t phase = 0; phase < phase_count && all > 0.0; ++phase) {
        trial.shares.emplace_back(phase_names[phase], clock.seconds()[phase] / all);
    }
}

/// \param warnings gets what a guard says if it stops the trial
io::TrialRun try_out(Simulation& simulation, double seconds, std::vector<std::string>& warnings) {
    Observer nobody;
    io::TrialRun trial;
    const std::uint64_t slice =
        std::clamp<std::uint64_t>(100'000 / (simulation.particle_count() + 1), 1, 1000);
    const auto start = Clock::now();
    bool finished = false;
    while (!finished && trial.wall_seconds < seconds) {
        try {
            finished = simulation.advance(slice, nobody);
        } catch (const Error& error) {
            if (error.kind() != ErrorKind::unstable) {
                throw;
            }
            finished = true;
            warnings.push_back(fmt::format("the first cycles end in trouble: {} ({})",
                                           error.diagnosis().what,
                                           error.diagnosis().likely_cause));
        }
        trial.wall_seconds = std::chrono::duration<double>(Clock::now() - start).count();
    }
    trial.cycles = simulation.cycle();
    trial.timestep = simulation.timestep();
    trial.particle_steps_per_second = static_cast<double>(trial.cycles) *
                                      static_cast<double>(simulation.particle_count()) /
                                      std::max(trial.wall_seconds, 1e-9);
    if (!finished) {
        measure_shares(simulation, 0.3 * seconds, trial);
    }
    return trial;
}

std::vector<io::StageCheck> check_stages(const Scene& scene, const ParticleFrame& particles) {
    std::vector<io::StageCheck> stages;
    const Contact* contact = &scene.contact;
    const Timestep* scheme = &scene.timestep;
    for (const Stage& stage : scene.stages) {
        contact = stage.contact ? &*stage.contact : contact;
        scheme = stage.timestep ? &*stage.timestep : scheme;
        io::StageCheck check;
        check.name = stage.name;
        check.duration = stage.duration;
        check.laws = laws_of(*contact);
        check.scales = contact_scales(scene, *contact, particles);
        check.scheme = std::visit([]<class S>(const S&) { return std::string(S::key); }, *scheme);
        check.planned_timestep = planned_timestep(*scheme, check.scales.limit.timestep);
        if (!std::holds_alternative<ScaledTimestep>(*scheme) && !check.scales.times.empty()) {
            check.steps_per_contact = check.scales.times.front().duration / check.planned_timestep;
        }
        stages.push_back(std::move(check));
    }
    return stages;
}

/// Automatic steps are taken to stay what they became in the trial, where the laws are the same.
void expect_cycles(io::CheckReport& report) {
    for (io::StageCheck& stage : report.stages) {
        double timestep = stage.planned_timestep;
        if (stage.scheme == AutomaticTimestep::key && report.trial.timestep > 0.0 &&
            stage.scales.limit.timestep == report.stages.front().scales.limit.timestep) {
            timestep = std::min(timestep, report.trial.timestep);
        }
        stage.expected_cycles =
            std::isfinite(timestep) ? std::ceil(stage.duration / timestep) : 0.0;
    }
}

io::DetectionCheck check_detection(const Scene& scene,
                                   const io::CheckReport& report,
                                   const ParticleFrame& particles) {
    io::DetectionCheck check;
    check.trigger =
        std::visit([]<class T>(const T&) { return std::string(T::key); }, scene.detection.trigger);
    check.fastest_now = fastest_wall(scene);
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < particles.size(); ++k) {
        smallest = std::min(smallest, particles.radius[k]);
        check.fastest_now = std::max(check.fastest_now, norm(particles.velocity[k]));
    }
    check.tolerance = particles.size() > 0 ? scene.detection.tolerance * smallest : 0.0;
    const auto* interval = std::get_if<RemapInterval>(&scene.detection.trigger);
    if (interval != nullptr && particles.size() > 0) {
        double longest = 0.0;
        for (const io::StageCheck& stage : report.stages) {
            longest = std::max(longest, stage.planned_timestep);
        }
        check.surest_approach =
            surest_approach_speed(scene.detection, smallest, longest, interval->cycles);
    }
    return check;
}

void warn(io::CheckReport& report, const Scene& scene) {
    for (const IdleEffect& idle : idle_effects(scene)) {
        report.warnings.push_back(idle.pointer + " does nothing: " + idle.reason);
    }
    if (report.particles == 0) {
        report.warnings.push_back("the scene has no particles");
    }
    for (std::size_t s = 0; s < report.stages.size(); ++s) {
        const io::StageCheck& stage = report.stages[s];
        if (stage.steps_per_contact && *stage.steps_per_contact < fewest_good_steps) {
            report.warnings.push_back(
                fmt::format("/stages/{}: {:.1f} steps in the shortest contact; below {:.0f} its "
                            "restitution and "
                            "duration are not those of the law. A step of {:.2e} s has {:.0f}",
                            s,
                            *stage.steps_per_contact,
                            fewest_good_steps,
                            stage.scales.times.front().duration / fewest_good_steps,
                            fewest_good_steps));
        }
        if (stage.scheme == FixedTimestep::key &&
            stage.planned_timestep > stage.scales.limit.timestep) {
            report.warnings.push_back(
                fmt::format("/stages/{}: the fixed step of {:.2e} s is above the single-contact "
                            "limit of {:.2e} s",
                            s,
                            stage.planned_timestep,
                            stage.scales.limit.timestep));
        }
    }
    for (const std::string& warning : opening_warnings(scene)) {
        report.warnings.push_back(warning);
    }
    const io::DetectionCheck& detection = report.detection;
    if (detection.surest_approach && *detection.surest_approach < detection.fastest_now) {
        report.warnings.push_back(
            fmt::format("/detection/trigger: contacts with approaches above {:.2g} m/s may be "
                        "found late; {:.2g} "
                        "m/s occurs",
                        *detection.surest_approach,
                        detection.fastest_now));
    }
}

}  // namespace

std::vector<std::string> opening_warnings(const Scene& scene) {
    std::vector<std::string> warnings;
    for (const NarrowOpening& opening : narrow_openings(scene)) {
        warnings.push_back(
            fmt::format("only {:.1f} diameters of '{}' fit across the wall '{}'; below {:.0f} the "
                        "walls may decide the result",
                        opening.diameters,
                        opening.species,
                        opening.wall,
                        fewest_diameters));
    }
    return warnings;
}

io::CheckReport check_scene(const Scene& scene, double trial_seconds) {
    const double before = resident_bytes();
    Simulation simulation(scene, 0);
    const ParticleFrame particles = simulation.particle_frame();
    io::CheckReport report;
    report.effects = effects_of(scene);
    report.realisations = scene.realisations.count;
    report.particles = simulation.particle_count();
    report.insertion.assign(simulation.insertion_reports().begin(),
                            simulation.insertion_reports().end());
    report.stages = check_stages(scene, particles);
    report.trial = try_out(simulation, trial_seconds, report.warnings);
    report.memory_bytes = static_cast<double>(report.realisations) *
                          std::max(resident_bytes() - before, archive_bytes(simulation));
    report.detection = check_detection(scene, report, simulation.particle_frame());
    expect_cycles(report);
    const double fastest = std::max(report.detection.fastest_now, speed_of_fall(scene, particles));
    for (io::StageCheck& stage : report.stages) {
        stage.softening = softening_of(stage.scales, fastest);
    }

    report.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    double particle_steps = 0.0;
    for (const io::StageCheck& stage : report.stages) {
        particle_steps += stage.expected_cycles * static_cast<double>(report.particles);
    }
    const auto count = static_cast<double>(report.realisations);
    if (report.trial.particle_steps_per_second > 0.0) {
        report.expected_seconds = count * particle_steps / report.trial.particle_steps_per_second /
                                  std::min<double>(report.threads, count);
    }
    warn(report, scene);
    return report;
}

}  // namespace grainbench::cli
