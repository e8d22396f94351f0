/// What a study file says: one scene, settings to compare on it, and what "the same" means. Read by
/// read_study, run by `grainbench study` (cli/study).
#pragma once

#include "core/describe.hpp"
#include "core/scene.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace grainbench::io {

/// What somebody else published of the same run.
struct PublishedCost {
    double seconds = 0.0;
    std::optional<std::int64_t> cycles;

    static constexpr auto fields() {
        return std::tuple{
            required(&PublishedCost::seconds, "seconds", "s", positive(), "computing time"),
            field(&PublishedCost::cycles, "cycles", "1", at_least(1), "cycles")};
    }
};

/// One setting: what it changes in the scene.
struct StudyVariant {
    std::string name{};
    std::vector<std::string> set{};
    std::optional<PublishedCost> published{};

    static constexpr auto fields() {
        return std::tuple{
            required(&StudyVariant::name, "name", "", any_number(), "name, unique in the study"),
            field(&StudyVariant::set,
                  "set",
                  "",
                  any_number(),
                  "changes \"/json/pointer=value\" of the scene, as --set takes them"),
            field(&StudyVariant::published,
                  "published",
                  "",
                  any_number(),
                  "what this setting took elsewhere, shown beside our own")};
    }
};

/// Settings of one knob.
struct StudyAxis {
    std::string name;
    std::vector<StudyVariant> values;

    static constexpr auto fields() {
        return std::tuple{required(&StudyAxis::name, "name", "", any_number(), "what is varied"),
                          required(&StudyAxis::values, "values", "", any_number(), "its settings")};
    }
};

/// The elevation over time, each point the mean of the rows in its part of the run. Rows that come
/// with the period of a shaking wall all show one phase of it: choose another history_interval.
struct ElevationCurve {
    static constexpr std::string_view key = "elevation_curve";
    std::int64_t points = 20;

    static constexpr auto fields() {
        return std::tuple{field(&ElevationCurve::points,
                                "points",
                                "1",
                                between(1, 1000),
                                "equal parts of the run, one point each")};
    }
};

/// The time at which the upper group first rose above the lower one. Realisations in which it never
/// did are left out, and counted.
struct EntrainmentTime {
    static constexpr std::string_view key = "entrainment_time";

    static constexpr auto fields() { return std::tuple{}; }
};

/// Any column of the history over time.
struct HistoryCurve {
    static constexpr std::string_view key = "history_curve";
    std::string column;
    std::int64_t points = 20;

    static constexpr auto fields() {
        return std::tuple{
            required(&HistoryCurve::column, "column", "", any_number(), "column of history.h5"),
            field(&HistoryCurve::points,
                  "points",
                  "1",
                  between(1, 1000),
                  "equal parts of the run, one point each: the mean of the column there")};
    }
};

enum class Reduction { final_value, mean, largest, smallest };

/// One number made of a column of the history.
struct HistoryNumber {
    static constexpr std::string_view key = "history_number";
    std::string column;
    Reduction reduction = Reduction::final_value;

    static constexpr auto fields() {
        return std::tuple{
            required(&HistoryNumber::column, "column", "", any_number(), "column of history.h5"),
            field(&HistoryNumber::reduction,
                  "reduction",
                  "",
                  any_number(),
                  "how the column becomes one number")};
    }
};

enum class ProfileAxis { x, y, z, radius };

/// Where the particles are in the end: their share of the volume along an axis, or by distance from
/// the z axis. Shares, so that scenes with other particles may be compared.
struct FinalProfile {
    static constexpr std::string_view key = "final_profile";
    ProfileAxis axis = ProfileAxis::z;
    double low = 0.0;
    double high = 1.0;
    std::int64_t bins = 10;

    static constexpr auto fields() {
        return std::tuple{
            field(&FinalProfile::axis, "axis", "", any_number(), "direction of the profile"),
            required(&FinalProfile::low, "low", "m", any_number(), "where it begins"),
            required(&FinalProfile::high, "high", "m", any_number(), "where it ends"),
            field(&FinalProfile::bins, "bins", "1", between(1, 1000), "equal parts")};
    }
};

using StudyObservable =
    std::variant<ElevationCurve, EntrainmentTime, HistoryCurve, HistoryNumber, FinalProfile>;

enum class Comparison { independent, paired };

/// Runs of single realisations of each variant, one at a time, for times that mean something. The
/// least time counts: other programs on the machine can only add to it. Variants take turns, so
/// that a disturbance does not meet one of them alone.
struct StudyTiming {
    std::optional<double> duration;
    std::int64_t repetitions = 3;

    static constexpr auto fields() {
        return std::tuple{field(&StudyTiming::duration,
                                "duration",
                                "s",
                                positive(),
                                "simulated time to be timed, from the start; absent = all of it"),
                          field(&StudyTiming::repetitions,
                                "repetitions",
                                "1",
                                between(1, 100),
                                "timed realisations of each variant, of which the fastest counts")};
    }
};

/// What --quick changes: a look whether the study runs, without a claim to its answer.
struct StudyQuick {
    std::vector<std::string> set;
    std::int64_t realisations = 2;
    std::vector<std::string> variants;

    static constexpr auto fields() {
        return std::tuple{
            field(&StudyQuick::set, "set", "", any_number(), "further changes of the scene"),
            field(&StudyQuick::realisations,
                  "realisations",
                  "1",
                  between(1, 10000),
                  "of each variant"),
            field(&StudyQuick::variants,
                  "variants",
                  "",
                  any_number(),
                  "only these, by name, and the reference; absent = all")};
    }
};

struct Study {
    static constexpr std::string_view format_name = "grainbench-study/1";

    std::string schema;
    std::string format{format_name};
    std::string title;
    std::string description;
    std::string scene;
    std::vector<std::string> set;
    std::vector<StudyVariant> variants;
    std::vector<StudyAxis> axes;
    std::string reference;
    StudyObservable observable;
    double margin = 1.0;
    std::int64_t realisations = 3;
    Comparison comparison = Comparison::independent;
    std::vector<std::int64_t> growth;
    std::optional<StudyTiming> timing;
    std::optional<StudyQuick> quick;

    static constexpr auto fields() {
        return std::tuple{
            field(&Study::schema, "$schema", "", any_number(), "schema for editors; not read"),
            required(&Study::format, "format", "", any_number(), "\"grainbench-study/1\""),
            field(&Study::title, "title", "", any_number(), "one line"),
            field(&Study::description, "description", "", any_number(), "what is asked, and why"),
            required(&Study::scene,
                     "scene",
                     "",
                     any_number(),
                     "scene that all variants start from, relative to this file"),
            field(&Study::set, "set", "", any_number(), "changes of the scene for all variants"),
            field(&Study::variants, "variants", "", any_number(), "settings to compare"),
            field(&Study::axes,
                  "axes",
                  "",
                  any_number(),
                  "knobs whose settings are combined; names of variants are joined by \", \""),
            required(&Study::reference,
                     "reference",
                     "",
                     any_number(),
                     "name of the variant that the others are compared with"),
            required(&Study::observable, "observable", "", any_number(), "what is compared"),
            required(&Study::margin,
                     "margin",
                     "",
                     positive(),
                     "largest difference that does not matter, in the unit of the observable"),
            field(
                &Study::realisations,
                "realisations",
                "1",
                between(1, 10000),
                "of each variant, with the same seeds: all variants start from the same packings"),
            field(&Study::comparison,
                  "comparison",
                  "",
                  any_number(),
                  "of means of independent samples, or of pairs that share a packing"),
            field(&Study::growth,
                  "growth",
                  "1",
                  at_least(2),
                  "also say what the first so many realisations would have said"),
            field(&Study::timing,
                  "timing",
                  "",
                  any_number(),
                  "time each variant alone; absent = times of the parallel runs"),
            field(&Study::quick, "quick", "", any_number(), "what --quick changes")};
    }
};

/// Reads a study file, with "extends". Throws Error(bad_input) that says what is wrong with it; the
/// scene is not looked at.
Study read_study(const std::filesystem::path& file);

/// The same rules for a study made in code.
/// \param name for messages
void validate_study(const Study& study, const std::string& name);

/// As JSON text that reads back the same.
std::string write_study(const Study& study);

/// The variants of the file, then all combinations of the axes.
std::vector<StudyVariant> variants_of(const Study& study);

std::string study_schema();

/// Markdown page with one table for each object of a study.
std::string study_reference();

}  // namespace grainbench::io

namespace grainbench {

template <>
struct EnumNames<io::Reduction> {
    static constexpr std::array<std::pair<io::Reduction, std::string_view>, 4> value{
        {{io::Reduction::final_value, "final"},
         {io::Reduction::mean, "mean"},
         {io::Reduction::largest, "largest"},
         {io::Reduction::smallest, "smallest"}}};
};

template <>
struct EnumNames<io::ProfileAxis> {
    static constexpr std::array<std::pair<io::ProfileAxis, std::string_view>, 4> value{
        {{io::ProfileAxis::x, "x"},
         {io::ProfileAxis::y, "y"},
         {io::ProfileAxis::z, "z"},
         {io::ProfileAxis::radius, "radius"}}};
};

template <>
struct EnumNames<io::Comparison> {
    static constexpr std::array<std::pair<io::Comparison, std::string_view>, 2> value{
        {{io::Comparison::independent, "independent"}, {io::Comparison::paired, "paired"}}};
};

}  // namespace grainbench
