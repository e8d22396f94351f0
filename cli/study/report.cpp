#include "cli/study/report.hpp"

#include "io/atomic_file.hpp"
#include "io/json/document.hpp"
#include "io/study.hpp"
#include "io/text.hpp"

#include "cli/build_info.hpp"
#include "cli/study/charts.hpp"
#include "cli/study/recommend.hpp"

#include <fmt/format.h>

#include <cmath>

namespace grainbench::cli {
namespace {

using io::Json;

bool has_published(const StudyResult& result) {
    for (const VariantResult& variant : result.variants) {
        if (variant.published) {
            return true;
        }
    }
    return false;
}

bool has_growth_chart(const StudyResult& result) {
    return !growth_chart(result).series.empty();
}

std::string realisations_text(const VariantResult& variant) {
    const std::size_t missing = variant.observation.missing;
    const std::size_t there = variant.observation.curves.size();
    return missing > 0 ? fmt::format("{} of {}", there, there + missing) : fmt::format("{}", there);
}

std::string spreads_text(const VariantResult& variant) {
    return variant.difference.at.empty() || variant.spreads == 0.0
               ? "-"
               : fmt::format("{:+.2g}", variant.spreads);
}

std::vector<std::string> published_cells(const VariantResult& variant) {
    if (!variant.published) {
        return {"-", "-", "-"};
    }
    return {fmt::format("{:.4g}", variant.published->seconds),
            variant.published->cycles ? fmt::format("{}", *variant.published->cycles) : "-",
            variant.cost.published_speed_up
                ? fmt::format("{:.3g}", *variant.cost.published_speed_up)
                : "-"};
}

/// What the reader should know of single variants.
std::vector<std::string> remarks(const StudyResult& result) {
    std::vector<std::string> lines;
    for (const VariantResult& variant : result.variants) {
        if (variant.unstable) {
            lines.push_back(fmt::format(
                "'{}': {}", variant.name, variant.message.substr(0, variant.message.find('\n'))));
        }
        if (variant.observation.missing > 0) {
            lines.push_back(
                fmt::format("'{}': {} of {} realisations have no {}",
                            variant.name,
                            variant.observation.missing,
                            variant.observation.missing + variant.observation.curves.size(),
                            result.quantity.name));
        }
        for (const std::string& warning : variant.warnings) {
            lines.push_back(fmt::format("'{}': {}", variant.name, warning));
        }
    }
    return lines;
}

std::string method_text(const StudyResult& result) {
    const VariantResult& reference = result.reference();
    return fmt::format(
        "Deviation: the largest difference of the mean {0} from that of '{1}' in {2}, with its 95 "
        "% "
        "interval{3}; in spreads: over the standard deviation of the realisations of '{1}' there. "
        "'same': shown to be within {4:.3g} {2} by two one-sided tests at 5 %; 'different': shown "
        "to "
        "be beyond it. Times are seconds of processor time for one realisation, {5}.",
        result.quantity.name,
        reference.name,
        result.quantity.unit.empty() ? "pure numbers" : result.quantity.unit,
        result.plan.study.comparison == io::Comparison::paired ? " from pairs of one packing"
                                                               : " (Welch)",
        result.plan.study.margin * result.quantity.scale,
        reference.cost.timed_alone ? "from runs one at a time" : "from the runs side by side");
}

std::string origin_text(const StudyOrigin& origin) {
    const BuildInfo build = build_info();
    return fmt::format("grainbench {} ({}), {}, {} threads, {}. Made by `{}`.",
                       build.version,
                       build.git_hash,
                       origin.cpu,
                       origin.threads,
                       origin.date,
                       origin.command);
}

Json json_of(const statistics::Estimate& estimate) {
    Json json{{"value", estimate.value}};
    if (std::isfinite(estimate.standard_error)) {
        const statistics::Interval interval = statistics::interval_of(estimate, 0.95);
        json["standard_error"] = estimate.standard_error;
        json["degrees_of_freedom"] = estimate.degrees_of_freedom;
        json["interval"] = {interval.low, interval.high};
    }
    return json;
}

Json json_of(const VariantCost& cost) {
    Json json{{"cycles", cost.cycles},
              {"particles", cost.particles},
              {"mean_timestep", cost.mean_timestep},
              {"step_time", cost.step_time},
              {"parallel_step_time", cost.parallel_step_time},
              {"timed_alone", cost.timed_alone},
              {"cpu_seconds", cost.seconds},
              {"speed_up", cost.speed_up}};
    if (cost.published_speed_up) {
        json["published_speed_up"] = *cost.published_speed_up;
    }
    return json;
}

Json json_of(const StudyResult& result, const VariantResult& variant) {
    Json json{{"name", variant.name},
              {"run", variant.folder.string()},
              {"realisations", variant.observation.curves.size()},
              {"missing", variant.observation.missing},
              {"steps_per_contact", variant.steps_per_contact},
              {"cost", json_of(variant.cost)}};
    if (variant.published) {
        json["published"] = {{"seconds", variant.published->seconds}};
        if (variant.published->cycles) {
            json["published"]["cycles"] = *variant.published->cycles;
        }
    }
    if (variant.unstable) {
        json["message"] = variant.message;
    }
    json["verdict"] = result.is_reference(variant) ? "reference"
                      : variant.unstable           ? "unstable"
                                         : std::string(statistics::name_of(variant.verdict));
    if (variant.needed) {
        json["realisations_to_decide"] = *variant.needed;
    }
    if (!variant.difference.at.empty()) {
        json["largest_at"] = result.x.at(variant.difference.largest);
        json["deviation"] = json_of(variant.largest());
        json["deviation_in_spreads"] = variant.spreads;
    }
    Json mean = Json::array();
    for (const statistics::Estimate& estimate : variant.mean) {
        mean.push_back(json_of(estimate));
    }
    json["mean"] = std::move(mean);
    for (const GrowthStep& step : variant.growth) {
        json["growth"].push_back({{"realisations", step.realisations},
                                  {"deviation", step.deviation},
                                  {"half_width", step.half_width},
                                  {"verdict", std::string(statistics::name_of(step.verdict))}});
    }
    return json;
}

/// Means and intervals of all variants at all points.
std::string curves_csv(const StudyResult& result) {
    std::string text = "variant,x,mean,low,high\n";
    for (const VariantResult& variant : result.variants) {
        for (std::size_t k = 0; k < variant.mean.size(); ++k) {
            const statistics::Interval interval = statistics::interval_of(variant.mean[k], 0.95);
            text += fmt::format("{},{},{},{},{}\n",
                                io::csv_field(variant.name),
                                io::to_text(result.x[k]),
                                io::to_text(variant.mean[k].value),
                                io::to_text(interval.low),
                                io::to_text(interval.high));
        }
    }
    return text;
}

std::string markdown_page(const StudyResult& result, const StudyOrigin& origin) {
    const io::Study& study = result.plan.study;
    std::string page = fmt::format("# {}\n\n{}\n\n**{}**\n\n{}\n{}\n\n",
                                   study.title.empty() ? "Study" : study.title,
                                   study.description,
                                   result.recommendation,
                                   markdown_of(variants_table(result)),
                                   method_text(result));
    for (const std::string& remark : remarks(result)) {
        page += fmt::format("- {}\n", remark);
    }
    page += "\n![means](overlay.svg)\n\n![cost and accuracy](cost.svg)\n";
    const Table growth = growth_table(result);
    if (!growth.rows.empty()) {
        page += fmt::format("\n## How confidence grows\n\n{}\n{}",
                            markdown_of(growth),
                            has_growth_chart(result) ? "![growth](growth.svg)\n" : "");
    }
    return fmt::format("{}\n{}\n", page, origin_text(origin));
}

std::string html_page(const StudyResult& result, const StudyOrigin& origin) {
    const io::Study& study = result.plan.study;
    const std::string title = html_escaped(study.title.empty() ? "Study" : study.title);
    std::string page = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta "
        "charset=\"utf-8\">\n<title>{0}</title>\n"
        "<style>body{{font-family:sans-serif;max-width:75em;margin:2em auto;padding:0 1em}}"
        "table{{border-collapse:collapse;font-size:90%}}td,th{{padding:.2em .7em;text-align:right;"
        "border-bottom:1px solid #ccc}}td:first-child,th:first-child{{text-align:left}}"
        "img{{max-width:100%;height:auto}}</style>\n</head>\n<body>\n<h1>{0}</h1>\n",
        title);
    page += fmt::format("<p>{}</p>\n<p><strong>{}</strong></p>\n",
                        html_escaped(study.description),
                        html_escaped(result.recommendation));
    page += html_of(variants_table(result));
    page += fmt::format("<p>{}</p>\n", html_escaped(method_text(result)));
    for (const std::string& remark : remarks(result)) {
        page += fmt::format("<p>{}</p>\n", html_escaped(remark));
    }
    page +=
        "<p><img src=\"overlay.svg\" alt=\"means of all variants\"></p>\n"
        "<p><img src=\"cost.svg\" alt=\"deviation against speed-up\"></p>\n";
    const Table growth = growth_table(result);
    if (!growth.rows.empty()) {
        page += fmt::format(
            "<h2>How confidence grows</h2>\n{}{}",
            html_of(growth),
            has_growth_chart(result)
                ? "<p><img src=\"growth.svg\" alt=\"interval against realisations\"></p>\n"
                : "");
    }
    page += fmt::format(
        "<p>Numbers: <a href=\"study.json\">study.json</a>, <a "
        "href=\"variants.csv\">variants.csv</a>, "
        "<a href=\"curves.csv\">curves.csv</a>. {}</p>\n</body>\n</html>\n",
        html_escaped(origin_text(origin)));
    return page;
}

}  // namespace

Table variants_table(const StudyResult& result) {
    Table table;
    table.header = {
        "variant",
        "realisations",
        "cycles",
        "mean dt [s]",
        "steps/contact",
        "ns/step",
        "time [s]",
        "speed-up",
        result.quantity.unit.empty() ? "deviation" : "deviation [" + result.quantity.unit + "]",
        "in spreads",
        "verdict"};
    const bool published = has_published(result);
    if (published) {
        table.header.insert(table.header.end(),
                            {"published time [s]", "published cycles", "published speed-up"});
    }
    for (const VariantResult& variant : result.variants) {
        std::vector<std::string> cells{variant.name,
                                       realisations_text(variant),
                                       fmt::format("{:.0f}", variant.cost.cycles),
                                       fmt::format("{:.3g}", variant.cost.mean_timestep),
                                       variant.steps_per_contact > 0.0
                                           ? fmt::format("{:.1f}", variant.steps_per_contact)
                                           : "-",
                                       fmt::format("{:.1f}", 1e9 * variant.cost.step_time),
                                       fmt::format("{:.3g}", variant.cost.seconds),
                                       fmt::format("{:.2f}", variant.cost.speed_up),
                                       deviation_text(variant, result.quantity),
                                       spreads_text(variant),
                                       verdict_text(result, variant)};
        if (published) {
            const std::vector<std::string> more = published_cells(variant);
            cells.insert(cells.end(), more.begin(), more.end());
        }
        table.rows.push_back(std::move(cells));
    }
    return table;
}

Table growth_table(const StudyResult& result) {
    Table table{{"variant", "realisations", "deviation", "+-", "verdict"}, {}};
    for (const VariantResult& variant : result.variants) {
        for (const GrowthStep& step : variant.growth) {
            table.rows.push_back({variant.name,
                                  fmt::format("{}", step.realisations),
                                  fmt::format("{:+.3g}", result.quantity.scale * step.deviation),
                                  fmt::format("{:.3g}", result.quantity.scale * step.half_width),
                                  std::string(statistics::name_of(step.verdict))});
        }
    }
    return table;
}

std::string study_text(const StudyResult& result) {
    std::string text = text_of(variants_table(result));
    const Table growth = growth_table(result);
    if (!growth.rows.empty()) {
        text += fmt::format("\n{}", text_of(growth));
    }
    for (const std::string& remark : remarks(result)) {
        text += fmt::format("note: {}\n", remark);
    }
    return fmt::format("{}\n{}\n", text, result.recommendation);
}

std::string study_csv(const StudyResult& result) {
    std::string text =
        "variant,realisations,missing,cycles,mean_timestep,steps_per_contact,step_time,cpu_seconds,"
        "speed_up,deviation,deviation_low,deviation_high,deviation_in_spreads,verdict,"
        "realisations_to_decide,published_seconds,published_cycles\n";
    for (const VariantResult& variant : result.variants) {
        const bool compared = !variant.difference.at.empty();
        const statistics::Interval interval =
            compared ? statistics::interval_of(variant.largest(), 0.95) : statistics::Interval{};
        const auto number = [](bool known, double value) {
            return known ? io::to_text(value) : std::string();
        };
        text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n",
                            io::csv_field(variant.name),
                            variant.observation.curves.size(),
                            variant.observation.missing,
                            io::to_text(variant.cost.cycles),
                            io::to_text(variant.cost.mean_timestep),
                            io::to_text(variant.steps_per_contact),
                            io::to_text(variant.cost.step_time),
                            io::to_text(variant.cost.seconds),
                            io::to_text(variant.cost.speed_up),
                            number(compared, variant.largest().value),
                            number(compared, interval.low),
                            number(compared, interval.high),
                            number(compared, variant.spreads),
                            result.is_reference(variant) ? "reference"
                            : variant.unstable           ? "unstable"
                                                         : statistics::name_of(variant.verdict),
                            variant.needed ? fmt::format("{}", *variant.needed) : "",
                            variant.published ? io::to_text(variant.published->seconds) : "",
                            variant.published && variant.published->cycles
                                ? fmt::format("{}", *variant.published->cycles)
                                : "");
    }
    return text;
}

std::string study_json(const StudyResult& result, const StudyOrigin& origin) {
    const BuildInfo build = build_info();
    Json variants = Json::array();
    for (const VariantResult& variant : result.variants) {
        variants.push_back(json_of(result, variant));
    }
    Json front = Json::array();
    for (const std::size_t k : result.pareto) {
        front.push_back(result.variants[k].name);
    }
    const Json json{{"format", "grainbench-study-result/1"},
                    {"version", build.version},
                    {"git_hash", build.git_hash},
                    {"cpu", origin.cpu},
                    {"threads", origin.threads},
                    {"date", origin.date},
                    {"command", origin.command},
                    {"quick", result.plan.quick},
                    {"study", Json::parse(io::write_study(result.plan.study))},
                    {"quantity", result.quantity.name},
                    {"margin", result.plan.study.margin},
                    {"recommendation", result.recommendation},
                    {"pareto_front", front},
                    {"x", result.x},
                    {"variants", variants}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_study_folder(const StudyResult& result,
                        const StudyOrigin& origin,
                        const std::filesystem::path& folder) {
    io::make_folder(folder);
    const render::ChartProvenance provenance{{"Software", "grainbench " + build_info().version},
                                             {"Source", origin.command}};
    render::write_chart(overlay_chart(result), folder / "overlay", provenance);
    render::write_chart(cost_chart(result), folder / "cost", provenance);
    if (has_growth_chart(result)) {
        render::write_chart(growth_chart(result), folder / "growth", provenance);
    }
    io::write_file(folder / "variants.csv", study_csv(result));
    io::write_file(folder / "curves.csv", curves_csv(result));
    io::write_file(folder / "study.json", study_json(result, origin));
    io::write_file(folder / "study.md", markdown_page(result, origin));
    io::write_file(folder / "index.html", html_page(result, origin));
}

}  // namespace grainbench::cli
