/// A set of figures as its JSON file says it: the runs that it needs, and what is drawn of them.
/// Files of the format "grainbench-figures/1", read by `grainbench figures`.
#pragma once

#include "core/describe.hpp"

#include "render/chart.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <variant>
#include <vector>

namespace grainbench {

template <>
struct EnumNames<render::AxisScale> {
    static constexpr std::array<std::pair<render::AxisScale, std::string_view>, 2> value{
        {{render::AxisScale::linear, "linear"}, {render::AxisScale::logarithmic, "logarithmic"}}};
};

}  // namespace grainbench

namespace grainbench::cli {

/// A scene that is run once for all figures that show it.
struct FigureRun {
    std::string name;
    std::string label;
    std::string scene;
    std::vector<std::string> set;
    std::vector<std::string> quick;
    std::optional<std::int64_t> look;

    static constexpr auto fields() {
        return std::tuple{
            required(&FigureRun::name, "name", "", any_number(), "name, unique in the set"),
            field(&FigureRun::label, "label", "", any_number(), "in legends; absent = the name"),
            required(
                &FigureRun::scene, "scene", "", any_number(), "scene file, relative to this file"),
            field(&FigureRun::set,
                  "set",
                  "",
                  any_number(),
                  "changes of the scene, as \"/json/pointer=value\""),
            field(&FigureRun::quick,
                  "quick",
                  "",
                  any_number(),
                  "changes that shorten the run for --quick, after those of the set"),
            field(&FigureRun::look,
                  "look",
                  "1",
                  at_least(0),
                  "entry in the table of colours and dashes; absent = place among the runs")};
    }
};

/// What is drawn of the realisations of a run.
enum class Show { realisations, mean, band };

/// One column of a run's history over time.
struct HistoryCurve {
    static constexpr std::string_view key = "history";
    std::string run;
    std::string column;
    Show show = Show::mean;
    std::optional<double> period;
    std::optional<std::int64_t> stage;
    std::optional<double> until;
    std::string name;
    std::optional<std::int64_t> look;
    bool heavy = false;

    static constexpr auto fields() {
        return std::tuple{
            required(&HistoryCurve::run, "run", "", any_number(), "name of the run"),
            required(&HistoryCurve::column, "column", "", any_number(), "column of its history"),
            field(&HistoryCurve::show,
                  "show",
                  "",
                  any_number(),
                  "a line for each realisation, their mean, or the mean with a band of one sample "
                  "standard deviation either side"),
            field(&HistoryCurve::period,
                  "period",
                  "s",
                  positive(),
                  "the column holds averages over intervals of this length: one point at the end "
                  "of each"),
            field(&HistoryCurve::stage,
                  "stage",
                  "1",
                  at_least(0),
                  "only this stage of the run, from 0; absent = all of it"),
            field(&HistoryCurve::until, "until", "s", positive(), "last time shown"),
            field(&HistoryCurve::name,
                  "name",
                  "",
                  any_number(),
                  "in the legend; absent = label of the run"),
            field(&HistoryCurve::look,
                  "look",
                  "1",
                  at_least(0),
                  "entry in the table of colours and dashes; absent = that of the run"),
            field(&HistoryCurve::heavy,
                  "heavy",
                  "",
                  any_number(),
                  "a heavy line without dashes and markers, to stand out among others")};
    }
};

/// Velocity of a wall as the scene prescribes it; needs no run.
struct WallVelocityCurve {
    static constexpr std::string_view key = "wall_velocity";
    std::string run;
    std::string wall;
    std::int64_t stage = 0;
    double duration = 1.0;
    std::string name;
    std::optional<std::int64_t> look;

    static constexpr auto fields() {
        return std::tuple{
            required(&WallVelocityCurve::run, "run", "", any_number(), "name of the run"),
            required(&WallVelocityCurve::wall, "wall", "", any_number(), "name of the wall"),
            field(&WallVelocityCurve::stage, "stage", "1", at_least(0), "stage, from 0"),
            required(&WallVelocityCurve::duration,
                     "duration",
                     "s",
                     positive(),
                     "time shown, from the start of the stage"),
            field(&WallVelocityCurve::name, "name", "", any_number(), "in the legend"),
            field(&WallVelocityCurve::look,
                  "look",
                  "1",
                  at_least(0),
                  "entry in the table of colours and dashes; absent = place in the figure")};
    }
};

/// A number that each realisation of a run ends with.
enum class Quantity {
    cycles,
    mean_timestep,
    largest_overlap_ratio,
    entrainment_time,
    cpu_seconds,
    particle_steps_per_second
};

/// How the points of a curve are drawn.
enum class Draw { line, points, bars };

/// One point for each of several runs: the mean over its realisations, with an error bar of one
/// sample standard deviation.
struct SummaryCurve {
    static constexpr std::string_view key = "summary";
    std::vector<std::string> runs;
    Quantity quantity = Quantity::cycles;
    std::optional<std::string> relative_to;
    std::vector<double> x;
    Draw draw = Draw::bars;
    std::string name;
    std::optional<std::int64_t> look;

    static constexpr auto fields() {
        return std::tuple{
            required(&SummaryCurve::runs, "runs", "", any_number(), "names of the runs"),
            required(&SummaryCurve::quantity, "quantity", "", any_number(), "what is drawn"),
            field(&SummaryCurve::relative_to,
                  "relative_to",
                  "",
                  any_number(),
                  "name of a run: numbers are divided by its mean, and say by what factor they "
                  "differ"),
            field(&SummaryCurve::x, "x", "", any_number(), "where each run stands; not for bars"),
            field(&SummaryCurve::draw, "draw", "", any_number(), "line, points or bars"),
            field(&SummaryCurve::name, "name", "", any_number(), "in the legend"),
            field(&SummaryCurve::look,
                  "look",
                  "1",
                  at_least(0),
                  "entry in the table of colours and dashes; absent = place in the figure")};
    }
};

/// Numbers given in the file, to compare with.
struct TableCurve {
    static constexpr std::string_view key = "table";
    std::vector<double> x;
    std::vector<double> y;
    Draw draw = Draw::points;
    std::string name;
    std::optional<std::int64_t> look;

    static constexpr auto fields() {
        return std::tuple{
            field(&TableCurve::x, "x", "", any_number(), "where each number stands; not for bars"),
            required(&TableCurve::y, "y", "", any_number(), "the numbers"),
            field(&TableCurve::draw, "draw", "", any_number(), "line, points or bars"),
            field(&TableCurve::name, "name", "", any_number(), "in the legend"),
            field(&TableCurve::look,
                  "look",
                  "1",
                  at_least(0),
                  "entry in the table of colours and dashes; absent = place in the figure")};
    }
};

using Curve = std::variant<HistoryCurve, WallVelocityCurve, SummaryCurve, TableCurve>;

struct FigureAxis {
    std::string label;
    std::string unit;
    render::AxisScale scale = render::AxisScale::linear;
    double factor = 1.0;
    std::optional<double> low;
    std::optional<double> high;

    static constexpr auto fields() {
        return std::tuple{
            required(&FigureAxis::label, "label", "", any_number(), "what the axis counts"),
            field(&FigureAxis::unit, "unit", "", any_number(), "unit of the numbers shown"),
            field(&FigureAxis::scale, "scale", "", any_number(), "linear or logarithmic"),
            field(&FigureAxis::factor,
                  "factor",
                  "1",
                  any_number(),
                  "numbers of runs, in SI units, are shown times this; tables as they are"),
            field(&FigureAxis::low, "low", "", any_number(), "least number; absent = of the data"),
            field(&FigureAxis::high,
                  "high",
                  "",
                  any_number(),
                  "largest number; absent = of the data")};
    }
};

/// A dashed line where a number of the axis is.
struct LineAt {
    static constexpr std::string_view key = "at";
    double x = 0.0;
    std::string text;

    static constexpr auto fields() {
        return std::tuple{required(&LineAt::x, "x", "", any_number(), "where it stands"),
                          field(&LineAt::text, "text", "", any_number(), "beside it")};
    }
};

/// A dashed line where a stage of a run begins.
struct LineAtStage {
    static constexpr std::string_view key = "stage";
    std::string run;
    std::int64_t stage = 0;
    std::string text;

    static constexpr auto fields() {
        return std::tuple{required(&LineAtStage::run, "run", "", any_number(), "name of the run"),
                          required(&LineAtStage::stage, "stage", "1", at_least(0), "stage, from 0"),
                          field(&LineAtStage::text, "text", "", any_number(), "beside it")};
    }
};

using FigureLine = std::variant<LineAt, LineAtStage>;

struct ChartFigure {
    static constexpr std::string_view key = "chart";
    std::string name;
    std::string title;
    std::string caption;
    FigureAxis x;
    FigureAxis y;
    std::vector<Curve> curves;
    std::vector<std::string> categories;
    std::vector<FigureLine> vertical_lines;

    static constexpr auto fields() {
        return std::tuple{
            required(&ChartFigure::name, "name", "", any_number(), "name of its files"),
            field(&ChartFigure::title, "title", "", any_number(), "above the chart"),
            required(&ChartFigure::caption, "caption", "", any_number(), "on the index page"),
            required(&ChartFigure::x, "x", "", any_number(), "axis across"),
            required(&ChartFigure::y, "y", "", any_number(), "axis upwards"),
            required(&ChartFigure::curves, "curves", "", any_number(), "what is drawn"),
            field(&ChartFigure::categories,
                  "categories",
                  "",
                  any_number(),
                  "labels below the bars, in their order"),
            field(&ChartFigure::vertical_lines,
                  "vertical_lines",
                  "",
                  any_number(),
                  "dashed lines over the whole height")};
    }
};

/// Frames of a run, each as one picture.
struct SnapshotFigure {
    static constexpr std::string_view key = "snapshot";
    std::string name;
    std::string caption;
    std::string run;
    std::string look;
    std::vector<std::string> set;
    std::vector<double> times;
    std::vector<double> quick_times;

    static constexpr auto fields() {
        return std::tuple{
            required(&SnapshotFigure::name, "name", "", any_number(), "name of its files"),
            required(&SnapshotFigure::caption, "caption", "", any_number(), "on the index page"),
            required(&SnapshotFigure::run, "run", "", any_number(), "name of the run"),
            required(&SnapshotFigure::look,
                     "look",
                     "",
                     any_number(),
                     "file that says how to draw it, relative to this file"),
            field(&SnapshotFigure::set,
                  "set",
                  "",
                  any_number(),
                  "changes of the look, as \"/json/pointer=value\""),
            required(&SnapshotFigure::times,
                     "times",
                     "s",
                     at_least(0.0),
                     "one picture for each, of the frame that is nearest"),
            field(&SnapshotFigure::quick_times,
                  "quick_times",
                  "s",
                  at_least(0.0),
                  "in place of `times` with --quick")};
    }
};

using Figure = std::variant<ChartFigure, SnapshotFigure>;

struct FigureSet {
    static constexpr std::string_view format_name = "grainbench-figures/1";

    std::string schema;
    std::string format;
    std::string title;
    std::string description;
    std::vector<std::string> quick;
    std::vector<FigureRun> runs;
    std::vector<Figure> figures;

    static constexpr auto fields() {
        return std::tuple{
            field(&FigureSet::schema, "$schema", "", any_number(), "schema for editors; not read"),
            required(&FigureSet::format, "format", "", any_number(), "\"grainbench-figures/1\""),
            field(&FigureSet::title, "title", "", any_number(), "title of the index page"),
            field(&FigureSet::description,
                  "description",
                  "",
                  any_number(),
                  "first paragraph of the index page"),
            field(&FigureSet::quick,
                  "quick",
                  "",
                  any_number(),
                  "changes of every scene with --quick, as \"/json/pointer=value\""),
            required(&FigureSet::runs, "runs", "", any_number(), "what is run"),
            required(&FigureSet::figures, "figures", "", any_number(), "what is drawn")};
    }
};

/// Reads a set. Error(bad_input) lists every problem, among them names of runs that there are not.
FigureSet read_figure_set(const std::filesystem::path& file);

/// JSON Schema (draft-07) of such a file.
std::string figure_set_schema();

/// Markdown page with one table for each object of a set.
std::string figure_set_reference();

/// Names that figures and messages go by.
const std::string& name_of(const Figure& figure);
const std::string& caption_of(const Figure& figure);

}  // namespace grainbench::cli

namespace grainbench {

template <>
struct EnumNames<cli::Show> {
    static constexpr std::array<std::pair<cli::Show, std::string_view>, 3> value{
        {{cli::Show::realisations, "realisations"},
         {cli::Show::mean, "mean"},
         {cli::Show::band, "band"}}};
};

template <>
struct EnumNames<cli::Draw> {
    static constexpr std::array<std::pair<cli::Draw, std::string_view>, 3> value{
        {{cli::Draw::line, "line"}, {cli::Draw::points, "points"}, {cli::Draw::bars, "bars"}}};
};

template <>
struct EnumNames<cli::Quantity> {
    static constexpr std::array<std::pair<cli::Quantity, std::string_view>, 6> value{
        {{cli::Quantity::cycles, "cycles"},
         {cli::Quantity::mean_timestep, "mean_timestep"},
         {cli::Quantity::largest_overlap_ratio, "largest_overlap_ratio"},
         {cli::Quantity::entrainment_time, "entrainment_time"},
         {cli::Quantity::cpu_seconds, "cpu_seconds"},
         {cli::Quantity::particle_steps_per_second, "particle_steps_per_second"}}};
};

}  // namespace grainbench
