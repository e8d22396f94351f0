#include "cli/run_command.hpp"

#include "core/ensemble.hpp"

#include "io/json/scene_json.hpp"

#include "cli/exit_codes.hpp"
#include "cli/interrupt.hpp"
#include "cli/jobs/scene_run.hpp"
#include "cli/progress.hpp"
#include "cli/render_command.hpp"
#include "cli/run_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <optional>
#include <thread>

namespace grainbench::cli {
namespace {

/// Builds all realisations, several at a time; nothing but complete ones comes out. Threads that
/// realisations side by side leave over share the work inside each of them.
std::vector<Simulation> build_simulations(const Scene& scene, unsigned threads) {
    const auto count = static_cast<std::size_t>(scene.realisations.count);
    std::vector<std::optional<Simulation>> built(count);
    std::vector<std::exception_ptr> failures(count);
    std::atomic<std::size_t> next = 0;
    SimulationOptions options;
    options.threads =
        std::max(1U, threads / static_cast<unsigned>(std::max<std::size_t>(1, count)));
    const auto work = [&] {
        for (std::size_t n = next++; n < count; n = next++) {
            try {
                built[n].emplace(scene, static_cast<int>(n), options);
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

double fraction_done(std::span<const Simulation> simulations) {
    double sum = 0.0;
    for (const Simulation& simulation : simulations) {
        const double end = simulation.end_time();
        sum += end > 0.0 ? std::min(1.0, simulation.time() / end) : 1.0;
    }
    return sum / static_cast<double>(simulations.size());
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
          run_(scene_,
               std::filesystem::absolute(arguments.scene).parent_path(),
               arguments.folder.empty() ? "out" / arguments.scene.stem() : arguments.folder,
               {.resume = arguments.resume, .history_csv = arguments.history_csv}) {}

    int execute() {
        std::optional<RenderJob> pictures;
        if (!arguments_.look.empty()) {
            // Now, so that a run does not end in the error of a look.
            pictures = job_of_look(run_.folder(), arguments_.look);
        }
        if (!run_.warning().empty()) {
            talk(fmt::format("warning: {}\n", run_.warning()));
        }
        resume();
        talk(insertion_text(scene_, simulations_));
        step();
        const io::Manifest manifest = run_.finish(threads_);
        talk(summary_text(manifest, run_.output_share()));
        talk(fmt::format("written to {}\n", run_.folder().string()));
        if (arguments_.json) {
            streams_.out << io::to_json(manifest);
        }
        if (manifest.outcome == "interrupted") {
            streams_.err << "interrupted; the same command with --resume goes on from here\n";
            return exit_interrupted;
        }
        if (manifest.outcome == "unstable") {
            streams_.err << "grainbench: " << manifest.message << "\n";
            return exit_unstable;
        }
        if (pictures) {
            draw_pictures(*pictures, [](const std::filesystem::path&, std::size_t) {});
            talk(fmt::format("pictures in {}\n", pictures->folder.string()));
        }
        return exit_ok;
    }

private:
    void talk(const std::string& text) const {
        if (!arguments_.quiet) {
            streams_.err << text << std::flush;
        }
    }

    void resume() {
        for (Simulation& simulation : simulations_) {
            if (run_.resume(simulation)) {
                talk(fmt::format("realisation {}: goes on from {:.4g} s\n",
                                 simulation.index() + 1,
                                 simulation.time()));
            }
        }
    }

    void step() {
        std::vector<Observer*> observers;
        std::size_t most = 1;
        for (const Simulation& simulation : simulations_) {
            observers.push_back(&run_.observer(static_cast<std::size_t>(simulation.index())));
            most = std::max(most, simulation.particle_count());
        }
        const EnsembleOptions options{.threads = threads_, .slice = slice_for(most)};
        std::vector<RealisationCost> costs;
        std::optional<RealisationError> stopped;
        try {
            Progress progress(streams_, arguments_.quiet, fraction_done(simulations_));
            costs = run_ensemble(simulations_,
                                 observers,
                                 options,
                                 interrupt_.requested(),
                                 [&](const EnsembleProgress& p) { progress.update(p); });
        } catch (const RealisationError& error) {
            if (error.kind() != ErrorKind::unstable) {
                throw;
            }
            costs = error.costs();
            stopped = error;
        }
        for (std::size_t n = 0; n < simulations_.size(); ++n) {
            if (stopped && stopped->realisation() == n) {
                run_.keep_unstable(simulations_[n], costs[n], *stopped);
            } else {
                run_.keep(simulations_[n], costs[n]);
            }
        }
    }

    const RunArguments& arguments_;
    const Streams& streams_;
    unsigned threads_;
    Interrupt interrupt_;
    Scene scene_;
    std::vector<Simulation> simulations_;
    SceneRun run_;
};

}  // namespace

int run_command(const RunArguments& arguments, const Streams& streams) {
    return Run(arguments, streams).execute();
}

}  // namespace grainbench::cli
