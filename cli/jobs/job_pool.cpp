#include "cli/jobs/job_pool.hpp"

#include "core/ensemble.hpp"

#include "cli/jobs/planned_steps.hpp"
#include "cli/jobs/run_cache.hpp"
#include "cli/jobs/scene_run.hpp"
#include "cli/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <thread>

namespace grainbench::cli {
namespace {

using Clock = std::chrono::steady_clock;

/// One run that is wanted, by one job or more.
struct WantedRun {
    std::string name;
    Scene scene;
    std::filesystem::path directory;
    std::filesystem::path folder;
    bool timed = false;
    bool reused = false;
    io::Manifest manifest;

    std::mutex opening;
    std::unique_ptr<SceneRun> run;  ///< from its first realisation to its last
    std::size_t left = 0;           ///< realisations that have not ended
};

/// One realisation of a run.
struct Unit {
    WantedRun* run = nullptr;
    std::size_t realisation = 0;
    double cycles = 0.0;     ///< [1] planned
    double particles = 0.0;  ///< [1] 0 until it is built
    double first = 0.0;      ///< [1] fraction that was done before
    double done = 0.0;       ///< [1] fraction that is done
    double steps = 0.0;      ///< [1] particle-steps of this call
};

/// An error with the name of the job in front of its place.
Error named(const Error& error, const std::string& name) {
    Diagnosis diagnosis = error.diagnosis();
    diagnosis.where = name + (diagnosis.where.empty() ? "" : ": " + diagnosis.where);
    return Error(error.kind(), diagnosis);
}

/// The threads and what they work on.
class Pool {
public:
    Pool(std::vector<WantedRun*> runs,
         unsigned threads,
         bool quiet,
         const std::atomic<bool>& stop,
         const Streams& streams)
        : runs_(std::move(runs)), threads_(threads), asked_to_stop_(stop), line_(streams, quiet) {
        for (WantedRun* run : runs_) {
            run->left = static_cast<std::size_t>(run->scene.realisations.count);
            const double cycles = planned_cycles(run->scene);
            for (std::size_t n = 0; n < run->left; ++n) {
                units_.push_back({.run = run, .realisation = n, .cycles = cycles});
            }
        }
    }

    void execute() {
        {
            std::vector<std::jthread> helpers;
            for (std::size_t t = 1; t < std::min<std::size_t>(threads_, units_.size()); ++t) {
                helpers.emplace_back([this] { work(); });
            }
            work();
        }
        for (WantedRun* run : runs_) {
            if (run->run && run->left > 0) {
                run->manifest = run->run->finish(threads_);
            }
            run->run.reset();
        }
        if (failure_) {
            std::rethrow_exception(failure_);
        }
    }

private:
    void work() {
        while (Unit* unit = take()) {
            try {
                step(*unit);
            } catch (const Error& error) {
                fail(std::make_exception_ptr(named(error, unit->run->name)));
            } catch (...) {
                fail(std::current_exception());
            }
        }
    }

    Unit* take() {
        const std::scoped_lock lock(mutex_);
        if (asked_to_stop_ || stop_ || next_ == units_.size()) {
            return nullptr;
        }
        return &units_[next_++];
    }

    void fail(std::exception_ptr failure) {
        const std::scoped_lock lock(mutex_);
        stop_ = true;
        if (!failure_) {
            failure_ = std::move(failure);
        }
    }

    /// The folder is made when the first realisation stands, so that a scene that cannot be built
    /// leaves none.
    SceneRun& open(WantedRun& wanted) {
        const std::scoped_lock lock(wanted.opening);
        if (!wanted.run) {
            wanted.run = std::make_unique<SceneRun>(wanted.scene,
                                                    wanted.directory,
                                                    wanted.folder,
                                                    io::RunFolderOptions{.resume = true});
        }
        return *wanted.run;
    }

    void step(Unit& unit) {
        Simulation simulation(unit.run->scene, static_cast<int>(unit.realisation));
        SceneRun& run = open(*unit.run);
        run.resume(simulation);
        begin(unit, simulation);
        Observer* observer = &run.observer(unit.realisation);
        const EnsembleOptions options{.threads = 1,
                                      .slice = slice_for(simulation.particle_count())};
        try {
            const std::vector<RealisationCost> costs = run_ensemble(
                {&simulation, 1}, {&observer, 1}, options, stop_, [&](const EnsembleProgress& p) {
                    report(unit, p);
                });
            run.keep(simulation, costs.front());
            if (!simulation.finished()) {
                return;
            }
        } catch (const RealisationError& error) {
            if (error.kind() != ErrorKind::unstable) {
                throw;
            }
            run.keep_unstable(simulation, error.costs().front(), error);
        }
        end(unit);
    }

    void begin(Unit& unit, const Simulation& simulation) {
        const std::scoped_lock lock(mutex_);
        unit.particles = static_cast<double>(simulation.particle_count());
        const double end = simulation.end_time();
        unit.first = end > 0.0 ? std::min(1.0, simulation.time() / end) : 0.0;
        unit.done = unit.first;
    }

    void end(Unit& unit) {
        WantedRun& wanted = *unit.run;
        bool was_last = false;
        {
            const std::scoped_lock lock(mutex_);
            unit.done = 1.0;
            was_last = --wanted.left == 0;
            ended_ += was_last ? 1 : 0;
        }
        if (was_last) {
            wanted.manifest = wanted.run->finish(threads_);
            wanted.run.reset();
        }
    }

    void report(Unit& unit, const EnsembleProgress& progress) {
        const std::scoped_lock lock(mutex_);
        stop_ = stop_ || asked_to_stop_;
        unit.done = std::max(unit.done, progress.fraction);
        unit.steps = progress.particle_steps;
        const double wall = std::chrono::duration<double>(Clock::now() - start_).count();
        if (line_.is_due(wall)) {
            line_.say(wall, text(wall));
        }
    }

    std::string text(double wall) const {
        double known = 0.0;
        double particles = 0.0;
        for (const Unit& unit : units_) {
            known += unit.particles > 0.0 ? 1.0 : 0.0;
            particles += unit.particles;
        }
        const double usual = known > 0.0 ? particles / known : 1.0;
        double all = 0.0;
        double done = 0.0;
        double first = 0.0;
        double steps = 0.0;
        for (const Unit& unit : units_) {
            const double weight = unit.cycles * (unit.particles > 0.0 ? unit.particles : usual);
            all += weight;
            done += weight * unit.done;
            first += weight * unit.first;
            steps += unit.steps;
        }
        std::string said = fmt::format("{:5.1f} %  {} of {} runs ended  {:.1f} M particle-steps/s",
                                       all > 0.0 ? 100.0 * done / all : 0.0,
                                       ended_,
                                       runs_.size(),
                                       1e-6 * steps / std::max(wall, 1e-9));
        if (done > first) {
            said += "  left " + duration_text((all - done) / (done - first) * wall);
        }
        return said;
    }

    std::vector<WantedRun*> runs_;
    std::vector<Unit> units_;
    unsigned threads_;
    const std::atomic<bool>& asked_to_stop_;
    std::atomic<bool> stop_ = false;
    const Clock::time_point start_ = Clock::now();
    std::mutex mutex_;
    ProgressLine line_;
    std::size_t next_ = 0;
    std::size_t ended_ = 0;
    std::exception_ptr failure_;
};

}  // namespace

std::vector<JobResult> run_jobs(std::span<const Job> jobs,
                                const JobOptions& options,
                                const std::atomic<bool>& stop,
                                const Streams& streams) {
    const RunCache cache(options.cache);
    std::deque<WantedRun> runs;
    std::map<std::filesystem::path, WantedRun*> by_folder;
    std::vector<WantedRun*> of_job;
    for (const Job& job : jobs) {
        Scene scene = job.scene;
        scene.schema.clear();  // where the schema lies is nothing that a run depends on
        const std::filesystem::path folder = cache.folder_of(scene, job.directory, job.timed);
        WantedRun*& run = by_folder[folder];
        if (run == nullptr) {
            run = &runs.emplace_back();
            run->name = job.name;
            run->scene = std::move(scene);
            run->directory = job.directory;
            run->folder = folder;
            run->timed = job.timed;
            run->manifest.outcome = "interrupted";
            if (auto manifest = RunCache::ended(folder)) {
                run->reused = true;
                run->manifest = std::move(*manifest);
            }
        }
        of_job.push_back(run);
    }

    const unsigned threads =
        options.threads > 0 ? options.threads : std::max(1U, std::thread::hardware_concurrency());
    for (const bool timed : {false, true}) {
        std::vector<WantedRun*> wanted;
        std::size_t all = 0;
        for (WantedRun& run : runs) {
            all += run.timed == timed ? 1 : 0;
            if (run.timed == timed && !run.reused) {
                wanted.push_back(&run);
            }
        }
        if (!options.quiet && all > 0) {
            streams.err << fmt::format("{} {}: {} to do, {} in the cache {}\n",
                                       all,
                                       timed ? "timed runs, one at a time" : "runs",
                                       wanted.size(),
                                       all - wanted.size(),
                                       options.cache.string())
                        << std::flush;
        }
        if (!wanted.empty() && !stop) {
            Pool(std::move(wanted), timed ? 1U : threads, options.quiet, stop, streams).execute();
        }
    }

    std::vector<JobResult> results;
    for (const WantedRun* run : of_job) {
        results.push_back({run->folder, run->manifest, run->reused});
    }
    return results;
}

bool all_ended(std::span<const JobResult> results) {
    return std::none_of(results.begin(), results.end(), [](const JobResult& result) {
        return result.manifest.outcome == "interrupted";
    });
}

}  // namespace grainbench::cli
