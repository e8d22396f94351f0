#include "cli/figures/figure_set.hpp"

#include "io/json/field_check.hpp"
#include "io/json/problems.hpp"
#include "io/json/read_described.hpp"
#include "io/json/reference_builder.hpp"
#include "io/json/schema_builder.hpp"

#include <algorithm>
#include <set>

namespace grainbench::cli {
namespace {

using io::Place;
using io::Problem;
using io::Problems;

/// Rules that a field table cannot say.
class Rules {
public:
    Rules(const FigureSet& set, Problems& problems) : set_(set), problems_(problems) {
        for (const FigureRun& run : set.runs) {
            runs_.push_back(run.name);
        }
    }

    void check() {
        const Place root;
        const Place runs = root.child("runs");
        std::set<std::string> names;
        for (std::size_t k = 0; k < set_.runs.size(); ++k) {
            check_name(runs.child(k), set_.runs[k].name, names);
        }
        const Place figures = root.child("figures");
        names.clear();
        for (std::size_t k = 0; k < set_.figures.size(); ++k) {
            const Place figure = figures.child(k);
            check_name(figure, name_of(set_.figures[k]), names);
            std::visit([&](const auto& each) { check_figure(figure, each); }, set_.figures[k]);
        }
    }

private:
    /// Names become file names, so they hold no more than those can.
    void check_name(const Place& place, const std::string& name, std::set<std::string>& names) {
        const bool is_plain =
            !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
                return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.';
            });
        if (!is_plain) {
            problems_.add({.pointer = place.child("name").pointer(),
                           .what = "'" + name + "' cannot be a name",
                           .likely_cause = "files are named by it",
                           .next_step = "use letters, digits, '-', '_' and '.' only"});
        } else if (!names.insert(name).second) {
            problems_.add({.pointer = place.child("name").pointer(),
                           .what = "the name '" + name + "' stands twice",
                           .likely_cause = "a copied entry",
                           .next_step = "give each entry a name of its own"});
        }
    }

    void check_run(const Place& place, const std::string& name) {
        if (std::find(runs_.begin(), runs_.end(), name) == runs_.end()) {
            problems_.add(io::unknown_name(place.pointer(), "run", name, runs_));
        }
    }

    void check_length(const Place& place, std::size_t found, std::size_t wanted) {
        if (found != wanted) {
            problems_.add({.pointer = place.pointer(),
                           .what = std::to_string(found) + " numbers where " +
                                   std::to_string(wanted) + " belong",
                           .likely_cause = "an entry was added or removed in one list only",
                           .next_step = "give one for each"});
        }
    }

    void check_figure(const Place& place, const ChartFigure& figure) {
        const Place curves = place.child("curves");
        for (std::size_t k = 0; k < figure.curves.size(); ++k) {
            const Place curve = curves.child(k);
            std::visit([&](const auto& each) { check_curve(curve, each); }, figure.curves[k]);
        }
        const Place lines = place.child("vertical_lines");
        for (std::size_t k = 0; k < figure.vertical_lines.size(); ++k) {
            if (const auto* line = std::get_if<LineAtStage>(&figure.vertical_lines[k])) {
                check_run(lines.child(k), line->run);
            }
        }
        if (figure.curves.empty()) {
            problems_.add({.pointer = curves.pointer(),
                           .what = "a chart without curves shows nothing",
                           .likely_cause = "an entry that was begun",
                           .next_step = "add a curve, or remove the figure"});
        }
    }

    void check_figure(const Place& place, const SnapshotFigure& figure) {
        check_run(place.child("run"), figure.run);
        if (figure.times.empty()) {
            problems_.add({.pointer = place.child("times").pointer(),
                           .what = "no time is given, so there is nothing to draw",
                           .likely_cause = "an entry that was begun",
                           .next_step = "give the times of the frames, or remove the figure"});
        }
    }

    void check_curve(const Place& place, const HistoryCurve& curve) {
        check_run(place.child("run"), curve.run);
    }

    void check_curve(const Place& place, const WallVelocityCurve& curve) {
        check_run(place.child("run"), curve.run);
    }

    void check_curve(const Place& place, const SummaryCurve& curve) {
        const Place runs = place.child("runs");
        for (std::size_t k = 0; k < curve.runs.size(); ++k) {
            check_run(runs.child(k), curve.runs[k]);
        }
        if (curve.relative_to) {
            check_run(place.child("relative_to"), *curve.relative_to);
        }
        check_length(
            place.child("x"), curve.x.size(), curve.draw == Draw::bars ? 0 : curve.runs.size());
    }

    void check_curve(const Place& place, const TableCurve& curve) {
        check_length(
            place.child("x"), curve.x.size(), curve.draw == Draw::bars ? 0 : curve.y.size());
    }

    const FigureSet& set_;
    Problems& problems_;
    std::vector<std::string_view> runs_;
};

}  // namespace

FigureSet read_figure_set(const std::filesystem::path& file) {
    auto set = io::read_described<FigureSet>(file);
    Problems problems;
    io::check_domains(set, Place{}, any_number(), "", problems);
    Rules(set, problems).check();
    problems.raise_if_any(file.string());
    return set;
}

std::string figure_set_schema() {
    io::SchemaBuilder builder;
    return io::pretty_text(io::file_schema<FigureSet>(
        builder, "grainbench figures", "Set of figures: runs, and what is drawn of them"));
}

std::string figure_set_reference() {
    io::ReferenceBuilder builder(
        R"(# Figure set reference

One JSON file describes a set of figures: the runs that it needs, and what is drawn of them.
`grainbench figures SET.json` runs and draws it. Files are named relative to the set; one set may extend
another, as scenes do. Numbers of runs are in SI units until `factor` of an axis changes that.

This page is made of the field tables of the program (`grainbench schema figures --markdown`); edit
those, not this.
)");
    builder.add_section<FigureSet>({});
    return builder.text();
}

const std::string& name_of(const Figure& figure) {
    return std::visit([](const auto& each) -> const std::string& { return each.name; }, figure);
}

const std::string& caption_of(const Figure& figure) {
    return std::visit([](const auto& each) -> const std::string& { return each.caption; }, figure);
}

}  // namespace grainbench::cli
