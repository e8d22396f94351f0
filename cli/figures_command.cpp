#include "cli/figures_command.hpp"

#include "io/atomic_file.hpp"
#include "io/hdf5/history.hpp"
#include "io/json/scene_json.hpp"

#include "render/look_json.hpp"
#include "render/snapshot.hpp"

#include "cli/build_info.hpp"
#include "cli/exit_codes.hpp"
#include "cli/figures/figure_chart.hpp"
#include "cli/figures/figure_index.hpp"
#include "cli/figures/figure_set.hpp"
#include "cli/interrupt.hpp"
#include "cli/jobs/job_pool.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

namespace grainbench::cli {
namespace {

namespace fs = std::filesystem;

/// Runs whose scene is not enough for the figures.
std::set<std::string> runs_to_do(const FigureSet& set) {
    std::set<std::string> names;
    const auto add = Overloaded{[&](const HistoryCurve& curve) { names.insert(curve.run); },
                                [&](const SummaryCurve& curve) {
                                    names.insert(curve.runs.begin(), curve.runs.end());
                                    if (curve.relative_to) {
                                        names.insert(*curve.relative_to);
                                    }
                                },
                                [](const WallVelocityCurve&) {},
                                [](const TableCurve&) {}};
    for (const Figure& figure : set.figures) {
        std::visit(Overloaded{[&](const ChartFigure& chart) {
                                  for (const Curve& curve : chart.curves) {
                                      std::visit(add, curve);
                                  }
                              },
                              [&](const SnapshotFigure& snapshot) { names.insert(snapshot.run); }},
                   figure);
    }
    return names;
}

class FigureMaker {
public:
    FigureMaker(const FiguresArguments& arguments, const Streams& streams)
        : arguments_(arguments),
          streams_(streams),
          set_(read_figure_set(arguments.set)),
          folder_(arguments.folder.empty() ? fs::path("out") / (arguments.set.stem().string() +
                                                                (arguments.quick ? "-quick" : ""))
                                           : arguments.folder) {}

    int execute() {
        plan();
        const std::vector<JobResult> results = run_jobs(
            jobs_,
            {.cache = folder_ / "runs", .threads = arguments_.jobs, .quiet = arguments_.quiet},
            interrupt_.requested(),
            streams_);
        if (!all_ended(results)) {
            return interrupted();
        }
        take(results);
        for (const Figure& figure : set_.figures) {
            if (interrupt_.requested()) {
                return interrupted();
            }
            std::visit([&](const auto& each) { draw(each); }, figure);
        }
        io::write_file(folder_ / "index.html", to_html(index_));
        io::write_file(folder_ / "index.md", to_markdown(index_));
        talk(fmt::format(
            "{} figures written to {}\n", set_.figures.size(), (folder_ / "index.html").string()));
        return code_;
    }

private:
    void talk(const std::string& text) const {
        if (!arguments_.quiet) {
            streams_.err << text << std::flush;
        }
    }

    int interrupted() const {
        streams_.err << "interrupted; the same command goes on from here\n";
        return exit_interrupted;
    }

    render::Look look_of(const SnapshotFigure& figure) const {
        return render::read_look(arguments_.set.parent_path() / figure.look, figure.set);
    }

    /// The scene of each run, and a job for those that a figure needs done. Whatever file is wrong
    /// is wrong now, not after the runs.
    void plan() {
        for (const Figure& figure : set_.figures) {
            if (const auto* snapshot = std::get_if<SnapshotFigure>(&figure)) {
                look_of(*snapshot);
            }
        }
        const std::set<std::string> wanted = runs_to_do(set_);
        for (std::size_t k = 0; k < set_.runs.size(); ++k) {
            const FigureRun& run = set_.runs[k];
            std::vector<std::string> changes = run.set;
            if (arguments_.quick) {
                changes.insert(changes.end(), set_.quick.begin(), set_.quick.end());
                changes.insert(changes.end(), run.quick.begin(), run.quick.end());
            }
            const fs::path file = arguments_.set.parent_path() / run.scene;
            ShownRun& shown = runs_[run.name];
            shown.label = run.label.empty() ? run.name : run.label;
            shown.look = run.look ? static_cast<std::size_t>(*run.look) : k;
            shown.scene = io::read_scene(file, changes);
            if (wanted.contains(run.name)) {
                jobs_.push_back(
                    {.name = run.name, .scene = shown.scene, .directory = file.parent_path()});
                IndexRun& entry = index_.runs.emplace_back();
                entry.name = run.name;
                entry.scene = scene_text(run.scene, changes);
            }
        }
    }

    static std::string scene_text(const std::string& scene,
                                  const std::vector<std::string>& changes) {
        std::string text = fs::path(scene).filename().string();
        for (const std::string& change : changes) {
            text += " " + change;
        }
        return text;
    }

    /// What the runs left behind.
    void take(const std::vector<JobResult>& results) {
        for (std::size_t k = 0; k < jobs_.size(); ++k) {
            ShownRun& run = runs_.at(jobs_[k].name);
            run.manifest = results[k].manifest;
            folder_of_run_[jobs_[k].name] = results[k].folder;
            run.history = io::read_history(results[k].folder / "history.h5");
            for (io::RealisationHistory& realisation : run.history.realisations) {
                realisation.traces = {};  // drawn from its own file
            }
            describe(results[k], index_.runs[k]);
            if (results[k].manifest.outcome == "unstable") {
                code_ = exit_unstable;
                streams_.err << "run '" << jobs_[k].name
                             << "' is drawn up to where it stopped: " << results[k].manifest.message
                             << "\n";
            }
        }
        const BuildInfo build = build_info();
        index_.title = set_.title.empty() ? arguments_.set.stem().string() : set_.title;
        index_.description = set_.description;
        index_.is_quick = arguments_.quick;
        index_.program = fmt::format("grainbench {} ({})", build.version, build.git_hash);
        index_.machine = cpu_model();
        index_.command = fmt::format("grainbench figures {}{}",
                                     arguments_.set.filename().string(),
                                     arguments_.quick ? " --quick" : "");
    }

    void describe(const JobResult& result, IndexRun& run) const {
        run.folder = result.folder.lexically_proximate(folder_).generic_string();
        run.outcome = result.manifest.outcome;
        run.realisations = static_cast<int>(result.manifest.realisations.size());
        for (const io::RealisationManifest& each : result.manifest.realisations) {
            run.time = std::max(run.time, each.summary.time);
            run.particles += each.particles;
            run.cycles += each.cycles;
            run.cpu_seconds += each.cpu_seconds;
        }
    }

    /// Where files of the figure go, without their extension.
    fs::path stem_of(const std::string& name) const { return folder_ / "figures" / name; }

    render::ChartProvenance provenance(const std::string& figure) const {
        return {
            {"Software", index_.program},
            {"Source", fmt::format("{}, figure {}", arguments_.set.filename().string(), figure)},
            {"Title", set_.title}};
    }

    void draw(const ChartFigure& figure) {
        io::make_folder(folder_ / "figures");
        render::write_chart(chart_of(figure, runs_), stem_of(figure.name), provenance(figure.name));
        const std::string stem = "figures/" + figure.name;
        index_.figures.push_back({.name = figure.name,
                                  .caption = figure.caption,
                                  .pictures = {{.file = stem + ".png", .note = ""}},
                                  .files = {stem + ".svg", stem + ".csv"}});
        talk(fmt::format("drew {}\n", figure.name));
    }

    void draw(const SnapshotFigure& figure) {
        render::SnapshotPainter painter(
            folder_of_run_.at(figure.run), look_of(figure), index_.program);
        IndexFigure entry;
        entry.name = figure.name;
        entry.caption = figure.caption;
        std::set<std::size_t> frames;
        const bool has_quick = arguments_.quick && !figure.quick_times.empty();
        for (const double time : has_quick ? figure.quick_times : figure.times) {
            frames.insert(painter.nearest(time));
        }
        for (const std::size_t frame : frames) {
            const std::string time = fmt::format("{:.4g}", painter.times().at(frame));
            const std::string name =
                frames.size() == 1 ? figure.name : fmt::format("{}-{}s", figure.name, time);
            const render::Snapshot snapshot = painter.draw(frame);
            io::make_folder(folder_ / "figures");
            render::write_png(stem_of(name).string() + ".png", snapshot.image, snapshot.text);
            entry.pictures.push_back({.file = "figures/" + name + ".png", .note = time + " s"});
            talk(fmt::format("drew {}\n", name));
        }
        index_.figures.push_back(std::move(entry));
    }

    const FiguresArguments& arguments_;
    const Streams& streams_;
    Interrupt interrupt_;
    FigureSet set_;
    fs::path folder_;
    ShownRuns runs_;
    std::vector<Job> jobs_;
    std::map<std::string, fs::path> folder_of_run_;
    FigureIndex index_;
    int code_ = exit_ok;
};

}  // namespace

int figures_command(const FiguresArguments& arguments, const Streams& streams) {
    return FigureMaker(arguments, streams).execute();
}

}  // namespace grainbench::cli
