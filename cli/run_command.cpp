#include "cli/run_command.hpp"

#include "core/effects.hpp"
#include "core/ensemble.hpp"

#include "io/json/scene_json.hpp"
#include "io/run_folder.hpp"

#include "cli/build_info.hpp"
#include "cli/exit_codes.hpp"
#include "cli/interrupt.hpp"
#include "cli/progress.hpp"
#include "cli/run_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <mutex>
#include <optional>
#include <set>
#include <thread>

namespace grainbench::cli {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Hands on what is reported and measures what it costs.
class TimedObserver : public Observer {
public:
    explicit TimedObserver(Observer& target) : target_(&target) {}

    void on_history(const Simulation& simulation) override {
        timed([&] { target_->on_history(simulation); });
    }

    void on_trace(const Simulation& simulation) override {
        timed([&] { target_->on_trace(simulation); });
    }

    void on_frame(const Simulation& simulation) override {
        timed([&] { target_->on_frame(simulation); });
    }

    void on_checkpoint(const Simulation& simulation) override {
        timed([&] { target_->on_checkpoint(simulation); });
    }

    double seconds() const { return seconds_; }

private:
    template <class Action>
    void timed(Action&& action) {
        const auto start = Clock::now();
        action();
        seconds_ += seconds_since(start);
    }

    Observer* target_;
    double seconds_ = 0.0;
};

/// Builds all realisations, several at a time; nothing but complete ones comes out.
std::vector<Simulation> build_simulations(const Scene& scene, unsigned threads) {
    const auto count = static_cast<std::size_t>(scene.realisations.count);
    std::vector<std::optional<Simulation>> built(count);
    std::vector<std::exception_ptr> failures(count);
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
        for (std::size_t n = next++; n < count; n = next++) {
            try {
                built[n].emplace(scene, static_cast<int>(n));
            } catch (...) {
                failures[n] = std::current_exception();
            }
        }
    };
    {
        std::vector<std::jthread> helpers;
        for (std::size_t t = 1; t < std::min<std::size_t>(threads, count); ++t) {
            helpers.emplace_back(work);
        }
        work();
    }
    std::vector<Simulation> simulations;
    for (std::size_t n = 0; n < count; ++n) {
        if (failures[n]) {
            std::rethrow_exception(failures[n]);
        }
        simulations.push_back(std::move(*built[n]));
    }
    return simulations;
}

/// Cycles between two looks at the clock and at signals: a hundredth of a second or so.
std::uint64_t slice_for(std::span<const Simulation> simulations) {
    std::size_t most = 1;
    for (const Simulation& simulation : simulations) {
        most = std::max(most, simulation.particle_count());
    }
    return std::clamp<std::uint64_t>(300'000 / most, 1, 5'000);
}

double fraction_done(std::span<const Simulation> simulations) {
    double sum = 0.0;
    for (const Simulation& simulation : simulations) {
        const double end = simulation.end_time();
        sum += end > 0.0 ? std::min(1.0, simulation.time() / end) : 1.0;
    }
    return sum / static_cast<double>(simulations.size());
}

/// The state in which a guard stopped, for looking: the particles whose numbers a view file can
/// hold, and the walls.
void write_last_frame(io::RunFolder& folder, const Simulation& simulation) {
    const ParticleFrame all = simulation.particle_frame();
    const auto is_drawable = [](const Vec3& v) {
        constexpr double limit = 1e30;  // well within single precision
        return std::abs(v.x) < limit && std::abs(v.y) < limit && std::abs(v.z) < limit;
    };
    ParticleFrame shown;
    shown.time = all.time;
    shown.cycle = all.cycle;
    for (std::size_t k = 0; k < all.size(); ++k) {
        if (!is_drawable(all.position[k]) || !is_drawable(all.velocity[k]) ||
            !is_drawable(all.angular_velocity[k]) || !is_drawable(all.force[k])) {
            continue;
        }
        shown.id.push_back(all.id[k]);
        shown.position.push_back(all.position[k]);
        shown.radius.push_back(all.radius[k]);
        shown.species.push_back(all.species[k]);
        shown.group.push_back(all.group[k]);
        shown.layer.push_back(all.layer[k]);
        shown.current_layer.push_back(all.current_layer[k]);
        shown.velocity.push_back(all.velocity[k]);
        shown.angular_velocity.push_back(all.angular_velocity[k]);
        shown.force.push_back(all.force[k]);
        shown.contacts.push_back(all.contacts[k]);
    }
    WallFrame walls = simulation.wall_frame();
    for (WallSurface& wall : walls.walls) {
        wall.force = is_drawable(wall.force) ? wall.force : Vec3{};
    }
    folder.write_frame(static_cast<std::size_t>(simulation.index()), shown, walls, nullptr);
}

/// One run from the scene to the manifest.
class Run {
public:
    Run(const RunArguments& arguments, const Streams& streams)
        : arguments_(arguments),
          streams_(streams),
          threads_(arguments.threads > 0 ? arguments.threads
                                         : std::max(1U, std::thread::hardware_concurrency())),
          scene_(io::read_scene(arguments.scene, arguments.overrides)),
          // Before the folder, so that a scene that cannot be built leaves none behind.
          simulations_(build_simulations(scene_, threads_)),
          folder_path_(arguments.folder.empty() ? "out" / arguments.scene.stem()
                                                : arguments.folder),
          folder_(folder_path_,
                  io::write_scene(scene_, std::filesystem::absolute(arguments.scene).parent_path()),
                  scene_,
                  simulations_.size(),
                  {.resume = arguments.resume, .history_csv = arguments.history_csv}) {}

    int execute() {
        talk(warning_text());
        resume();
        talk(insertion_text(scene_, simulations_));
        for (std::size_t n = 0; n < simulations_.size(); ++n) {
            observers_.emplace_back(folder_.observer(n));
            first_cycles_.push_back(simulations_[n].cycle());
        }
        const int code = step();
        const io::Manifest manifest = make_manifest();
        folder_.finish(manifest);
        talk(summary_text(manifest, output_share()));
        talk(fmt::format("written to {}\n", folder_path_.string()));
        if (arguments_.json) {
            streams_.out << io::to_json(manifest);
        }
        if (code == exit_interrupted) {
            streams_.err << "interrupted; the same command with --resume goes on from here\n";
        } else if (code == exit_unstable) {
            streams_.err << "grainbench: " << message_ << "\n";
        }
        return code;
    }

private:
    void talk(const std::string& text) const {
        if (!arguments_.quiet) {
            streams_.err << text << std::flush;
        }
    }

    std::string warning_text() const {
        return folder_.warning().empty() ? "" : "warning: " + folder_.warning() + "\n";
    }

    void resume() {
        const auto archives = folder_.load_checkpoint();
        for (std::size_t n = 0; n < simulations_.size(); ++n) {
            if (archives[n]) {
                simulations_[n].load(*archives[n]);
                talk(fmt::format(
                    "realisation {}: goes on from {:.4g} s\n", n + 1, simulations_[n].time()));
            }
        }
    }

    /// Returns the exit code and sets outcome, message and costs.
    int step() {
        std::vector<Observer*> observers;
        for (TimedObserver& observer : observers_) {
            observers.push_back(&observer);
        }
        const EnsembleOptions options{.threads = threads_, .slice = slice_for(simulations_)};
        try {
            Progress progress(streams_, arguments_.quiet, fraction_done(simulations_));
            costs_ = run_ensemble(simulations_,
                                  observers,
                                  options,
                                  interrupt_.requested(),
                                  [&](const EnsembleProgress& p) { progress.update(p); });
        } catch (const RealisationError& error) {
            if (error.kind() != ErrorKind::unstable) {
                throw;
            }
            costs_ = error.costs();
            return stop_unstable(error);
        }
        const bool finished = std::all_of(simulations_.begin(),
                                          simulations_.end(),
                                          [](const Simulation& s) { return s.finished(); });
        if (finished) {
            outcome_ = "finished";
            return exit_ok;
        }
        outcome_ = "interrupted";
        message_ = "stopped by a signal";
        for (std::size_t n = 0; n < simulations_.size(); ++n) {
            observers_[n].on_checkpoint(simulations_[n]);
        }
        return exit_interrupted;
    }

    /// The checkpoint of the run stays the last good one: no state after it is worth keeping.
    int stop_unstable(const RealisationError& error) {
        outcome_ = "unstable";
        message_ =
            fmt::format("realisation {} is unstable: {}", error.realisation() + 1, error.what());
        write_last_frame(folder_, simulations_[error.realisation()]);
        return exit_unstable;
    }

    double output_share() const {
        double output = 0.0;
        double all = 0.0;
        for (std::size_t n = 0; n < costs_.size(); ++n) {
            output += observers_[n].seconds();
            all += costs_[n].wall_seconds;
        }
        return all > 0.0 ? std::min(1.0, output / all) : 0.0;
    }

    io::Manifest make_manifest() const {
        const BuildInfo build = build_info();
        io::Manifest manifest{.version = build.version,
                              .git_hash = build.git_hash,
                              .compiler = build.compiler,
                              .compiler_flags = build.flags,
                              .cpu = cpu_model(),
                              .isa = simulations_.front().isa(),
                              .threads = static_cast<int>(threads_),
                              .outcome = outcome_,
                              .message = message_,
                              .effects = {},
                              .wall_seconds = seconds_since(start_),
                              .realisations = {}};
        for (const Effect& effect : effects_of(scene_)) {
            if (std::find(manifest.effects.begin(), manifest.effects.end(), effect.name) ==
                manifest.effects.end()) {
                manifest.effects.push_back(effect.name);
            }
        }
        for (std::size_t n = 0; n < simulations_.size(); ++n) {
            manifest.realisations.push_back(describe(n));
        }
        return manifest;
    }

    io::RealisationManifest describe(std::size_t n) const {
        const Simulation& simulation = simulations_[n];
        const auto reports = simulation.insertion_reports();
        io::RealisationManifest result{
            .seed = scene_.realisations.seed + static_cast<std::int64_t>(n),
            .particles = simulation.particle_count(),
            .cycles = simulation.cycle(),
            .wall_seconds = costs_[n].wall_seconds,
            .cpu_seconds = costs_[n].cpu_seconds,
            .particle_steps_per_second = 0.0,
            .insertion = {reports.begin(), reports.end()},
            .summary = simulation.summary(),
            .state_hash = simulation.state_hash()};
        if (result.wall_seconds > 0.0) {
            const auto cycles = static_cast<double>(simulation.cycle() - first_cycles_[n]);
            result.particle_steps_per_second =
                cycles * static_cast<double>(result.particles) / result.wall_seconds;
        }
        return result;
    }

    const RunArguments& arguments_;
    const Streams& streams_;
    Clock::time_point start_ = Clock::now();
    unsigned threads_;
    Interrupt interrupt_;
    Scene scene_;
    std::vector<Simulation> simulations_;
    std::filesystem::path folder_path_;
    io::RunFolder folder_;
    std::vector<TimedObserver> observers_;
    std::vector<std::uint64_t> first_cycles_;
    std::vector<RealisationCost> costs_;
    std::string outcome_;
    std::string message_;
};

}  // namespace

int run_command(const RunArguments& arguments, const Streams& streams) {
    return Run(arguments, streams).execute();
}

}  // namespace grainbench::cli
