#include "cli/jobs/scene_run.hpp"

#include "core/effects.hpp"

#include "io/atomic_file.hpp"
#include "io/json/scene_json.hpp"

#include "cli/build_info.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grainbench::cli {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The manifest of a run that was interrupted: its costs go on, and starting anew removes it.
std::optional<io::Manifest> manifest_before(const std::filesystem::path& folder, bool resume) {
    const std::filesystem::path file = folder / "manifest.json";
    if (!resume || !io::file_exists(file)) {
        return std::nullopt;
    }
    return io::read_manifest(file);
}

/// The particles whose numbers a view file can hold.
ParticleFrame drawable_part(const ParticleFrame& all) {
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
        if (!all.orientation.empty()) {
            shown.orientation.push_back(all.orientation[k]);
        }
    }
    return shown;
}

WallFrame drawable_walls(const Simulation& simulation) {
    WallFrame frame = simulation.wall_frame();
    for (WallSurface& wall : frame.walls) {
        const bool is_finite =
            std::isfinite(wall.force.x + wall.force.y + wall.force.z) && norm(wall.force) < 1e30;
        wall.force = is_finite ? wall.force : Vec3{};
    }
    return frame;
}

}  // namespace

std::uint64_t slice_for(std::size_t particles) {
    return std::clamp<std::uint64_t>(300'000 / std::max<std::size_t>(1, particles), 1, 5'000);
}

/// Hands on what is reported and measures what it costs.
class SceneRun::TimedObserver : public Observer {
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

    void on_fields(const Simulation& simulation) override {
        timed([&] { target_->on_fields(simulation); });
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

SceneRun::SceneRun(Scene scene,
                   const std::filesystem::path& directory,
                   std::filesystem::path folder,
                   const io::RunFolderOptions& options)
    : scene_(std::move(scene)),
      path_(std::move(folder)),
      before_(manifest_before(path_, options.resume)),
      folder_(path_,
              io::write_scene(scene_, std::filesystem::current_path() / directory),
              scene_,
              static_cast<std::size_t>(scene_.realisations.count),
              options),
      parts_(static_cast<std::size_t>(scene_.realisations.count)) {
    for (std::size_t n = 0; n < parts_.size(); ++n) {
        observers_.push_back(std::make_unique<TimedObserver>(folder_.observer(n)));
    }
}

SceneRun::~SceneRun() = default;

bool SceneRun::resume(Simulation& simulation) {
    const auto n = static_cast<std::size_t>(simulation.index());
    const auto archives = folder_.load_checkpoint();
    if (archives.at(n)) {
        simulation.load(*archives[n]);
    }
    parts_.at(n).first_cycle = simulation.cycle();
    return archives[n].has_value();
}

Observer& SceneRun::observer(std::size_t realisation) {
    return *observers_.at(realisation);
}

void SceneRun::keep(const Simulation& simulation, const RealisationCost& cost) {
    const auto n = static_cast<std::size_t>(simulation.index());
    if (!simulation.finished()) {
        observers_.at(n)->on_checkpoint(simulation);
    }
    describe(simulation, cost);
}

void SceneRun::keep_unstable(const Simulation& simulation,
                             const RealisationCost& cost,
                             const Error& error) {
    const auto n = static_cast<std::size_t>(simulation.index());
    folder_.drain();
    folder_.write_frame(
        n, drawable_part(simulation.particle_frame()), drawable_walls(simulation), nullptr);
    describe(simulation, cost);
    const std::scoped_lock lock(mutex_);
    parts_.at(n).unstable = true;
    if (message_.empty()) {
        message_ = fmt::format("realisation {} is unstable: {}", n + 1, error.what());
    }
}

void SceneRun::describe(const Simulation& simulation, const RealisationCost& cost) {
    const auto n = static_cast<std::size_t>(simulation.index());
    const auto reports = simulation.insertion_reports();
    io::RealisationManifest said{.seed = scene_.realisations.seed + static_cast<std::int64_t>(n),
                                 .particles = simulation.particle_count(),
                                 .cycles = simulation.cycle(),
                                 .timed_cycles = simulation.cycle() - parts_.at(n).first_cycle,
                                 .wall_seconds = cost.wall_seconds,
                                 .cpu_seconds = cost.cpu_seconds,
                                 .particle_steps_per_second = 0.0,
                                 .insertion = {reports.begin(), reports.end()},
                                 .summary = simulation.summary(),
                                 .state_hash = simulation.state_hash()};
    if (before_ && n < before_->realisations.size() &&
        before_->realisations[n].cycles == parts_[n].first_cycle) {
        said.timed_cycles += before_->realisations[n].timed_cycles;
        said.wall_seconds += before_->realisations[n].wall_seconds;
        said.cpu_seconds += before_->realisations[n].cpu_seconds;
    }
    if (said.wall_seconds > 0.0) {
        said.particle_steps_per_second = static_cast<double>(said.timed_cycles) *
                                         static_cast<double>(said.particles) / said.wall_seconds;
    }
    const std::scoped_lock lock(mutex_);
    parts_[n].finished = simulation.finished();
    parts_[n].said = std::move(said);
    isa_ = simulation.isa();
}

double SceneRun::output_share() const {
    const std::scoped_lock lock(mutex_);
    double output = 0.0;
    double all = 0.0;
    for (std::size_t n = 0; n < parts_.size(); ++n) {
        output += observers_[n]->seconds();
        all += parts_[n].said ? parts_[n].said->wall_seconds : 0.0;
    }
    return all > 0.0 ? std::min(1.0, output / all) : 0.0;
}

io::Manifest SceneRun::finish(unsigned threads) {
    const BuildInfo build = build_info();
    io::Manifest manifest{.version = build.version,
                          .git_hash = build.git_hash,
                          .compiler = build.compiler,
                          .compiler_flags = build.flags,
                          .cpu = cpu_model(),
                          .isa = isa_,
                          .threads = static_cast<int>(threads),
                          .outcome = "finished",
                          .message = message_,
                          .effects = {},
                          .wall_seconds = seconds_since(start_),
                          .realisations = {}};
    if (before_) {
        manifest.wall_seconds += before_->wall_seconds;
    }
    bool stopped = false;
    bool unstable = false;
    for (std::size_t n = 0; n < parts_.size(); ++n) {
        const Part& part = parts_[n];
        unstable = unstable || part.unstable;
        stopped = stopped || !(part.finished || part.unstable);
        io::RealisationManifest nothing;
        nothing.seed = scene_.realisations.seed + static_cast<std::int64_t>(n);
        manifest.realisations.push_back(part.said.value_or(nothing));
    }
    if (unstable) {
        manifest.outcome = "unstable";
    } else if (stopped) {
        manifest.outcome = "interrupted";
        manifest.message = "stopped by a signal";
    }
    for (const Effect& effect : effects_of(scene_)) {
        if (std::find(manifest.effects.begin(), manifest.effects.end(), effect.name) ==
            manifest.effects.end()) {
            manifest.effects.push_back(effect.name);
        }
    }
    folder_.finish(manifest);
    return manifest;
}

}  // namespace grainbench::cli
