#include "cli/study/single_contact.hpp"

#include "io/atomic_file.hpp"
#include "io/text.hpp"

#include "cli/build_info.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grainbench::cli {
namespace {

using render::AxisScale;
using render::Chart;
using render::ChartSeries;
using verify::Outcome;
using verify::StepPoint;
using verify::WorkCurve;
using verify::WorkPoint;

constexpr std::size_t outcome_count = verify::outcome_names.size();

/// The laws of the example: springs that build up, dashpots without tension or slip.
const WorkCurve& example_curve(const SingleContactResult& result) {
    return *std::find_if(result.curves.begin(), result.curves.end(), [](const WorkCurve& curve) {
        return curve.laws.incremental && curve.laws.damping_mode == 3;
    });
}

Chart logarithmic_chart(std::string title, std::string error) {
    Chart chart;
    chart.title = std::move(title);
    chart.x = {.label = "steps in the undamped contact", .scale = AxisScale::logarithmic};
    chart.y = {.label = std::move(error), .scale = AxisScale::logarithmic};
    return chart;
}

ChartSeries series_of(const WorkCurve& curve, std::size_t outcome, std::string name) {
    ChartSeries series{.name = std::move(name)};
    for (const WorkPoint& point : curve.points) {
        if (point.error[outcome] > 0.0) {
            series.x.push_back(point.steps);
            series.y.push_back(point.error[outcome]);
        }
    }
    return series;
}

const char* explanation =
    "A small sphere hits a plane at 45 degrees and 1 m/s (k = 1e5 N/m, friction 0.6, damping ratio "
    "0.1 where damped). Errors are against the limit of small steps, root mean squares over "
    "sixteen "
    "moments at which a step may meet the first touch.";

const char* step_explanation =
    "Pairs of the example's small spheres, undamped, at five angles. A contact lasts 9.15e-5 s: "
    "9.1 "
    "steps of 1e-5 s, 4.6 of 2e-5 s, 3.05 of 3e-5 s. A longer step meets the spheres deeper at "
    "their "
    "first touch and holds them longer after their last, so energy appears and vanishes by chance. "
    "Two spheres that stick to each other are unstable above 3.11e-5 s: at 3e-5 s nothing is left "
    "for a second contact, which every sphere in a bed has now and then.";

double error_at(const SingleContactResult& result, double timestep) {
    for (const StepPoint& point : result.steps) {
        if (std::abs(point.timestep - timestep) < 1e-9) {
            return point.energy_error;
        }
    }
    return 0.0;
}

std::string finding(const SingleContactResult& result) {
    return fmt::format(
        "Root mean square error of the energy after an impact: {:.2g} at 1e-5 s, "
        "{:.2g} at 2e-5 s, {:.2g} at 3e-5 s, {:.2g} at 4e-5 s.",
        error_at(result, 1e-5),
        error_at(result, 2e-5),
        error_at(result, 3e-5),
        error_at(result, 4e-5));
}

std::string csv_of(const SingleContactResult& result) {
    std::string text = "laws,steps_per_contact";
    for (const std::string_view name : verify::outcome_names) {
        text += fmt::format(",error of {}", name);
    }
    text += "\n";
    for (const WorkCurve& curve : result.curves) {
        for (const WorkPoint& point : curve.points) {
            text += fmt::format("{},{}", io::csv_field(curve.laws.name), io::to_text(point.steps));
            for (const double error : point.error) {
                text += fmt::format(",{}", io::to_text(error));
            }
            text += "\n";
        }
    }
    return text;
}

}  // namespace

SingleContactResult study_single_contact() {
    std::vector<double> timesteps;
    for (int tenth = 10; tenth <= 400; tenth += 10) {
        timesteps.push_back(1e-7 * tenth);
    }
    return {verify::work_precision(), verify::errors_against_step(timesteps)};
}

Table orders_table(const SingleContactResult& result) {
    Table table;
    table.header = {"order of convergence"};
    for (const std::string_view name : verify::outcome_names) {
        table.header.emplace_back(name);
    }
    for (const WorkCurve& curve : result.curves) {
        std::vector<std::string> cells{curve.laws.name};
        for (const double order : curve.order) {
            cells.push_back(std::isnan(order) ? "exact" : fmt::format("{:.2f}", order));
        }
        table.rows.push_back(std::move(cells));
    }
    return table;
}

Table errors_table(const SingleContactResult& result) {
    const WorkCurve& curve = example_curve(result);
    Table table;
    table.header = {"error at steps per contact"};
    std::vector<std::size_t> chosen;
    for (std::size_t k = 0; k < curve.points.size(); ++k) {
        const double steps = curve.points[k].steps;
        if (steps == 3.0 || steps == 5.0 || steps == 7.0 || steps == 15.0 || steps == 30.0 ||
            steps == 100.0 || steps == 400.0) {
            chosen.push_back(k);
            table.header.push_back(fmt::format("{:.0f}", steps));
        }
    }
    for (std::size_t outcome = 0; outcome < outcome_count; ++outcome) {
        std::vector<std::string> cells{std::string(verify::outcome_names[outcome])};
        for (const std::size_t k : chosen) {
            cells.push_back(fmt::format("{:.2g}", curve.points[k].error[outcome]));
        }
        table.rows.push_back(std::move(cells));
    }
    return table;
}

Chart work_chart(const SingleContactResult& result, Outcome outcome) {
    const auto index = static_cast<std::size_t>(outcome);
    const std::string name(verify::outcome_names[index]);
    Chart chart = logarithmic_chart("One impact: error of the " + name + " against its cost",
                                    "error of the " + name);
    for (const WorkCurve& curve : result.curves) {
        chart.series.push_back(series_of(curve, index, curve.laws.name));
    }
    return chart;
}

Chart outcomes_chart(const SingleContactResult& result) {
    const WorkCurve& curve = example_curve(result);
    Chart chart = logarithmic_chart("One impact with the example's laws: errors against steps",
                                    "root mean square error");
    for (std::size_t outcome = 0; outcome < outcome_count; ++outcome) {
        chart.series.push_back(
            series_of(curve, outcome, std::string(verify::outcome_names[outcome])));
    }
    return chart;
}

Chart step_chart(const SingleContactResult& result) {
    Chart chart;
    chart.title = "Why 2e-5 s works and 3e-5 s does not";
    chart.x = {.label = "timestep", .unit = "us"};
    chart.y = {.label = "error of the energy after an impact",
               .unit = "% of the energy before",
               .scale = AxisScale::logarithmic};
    ChartSeries mean{.name = "root mean square"};
    ChartSeries largest{.name = "largest of 80 impacts"};
    for (const StepPoint& point : result.steps) {
        mean.x.push_back(1e6 * point.timestep);
        mean.y.push_back(100.0 * point.energy_error);
        largest.x.push_back(1e6 * point.timestep);
        largest.y.push_back(100.0 * point.largest_error);
    }
    chart.series = {std::move(mean), std::move(largest)};
    const double contact = 1e6 * verify::small_pair_contact_time();
    chart.vertical_lines = {
        {.x = 10.0, .text = fmt::format("1e-5 s: {:.1f} steps", contact / 10.0)},
        {.x = 20.0, .text = fmt::format("2e-5 s: {:.1f} steps", contact / 20.0)},
        {.x = 30.0, .text = fmt::format("3e-5 s: {:.2f} steps", contact / 30.0)},
        {.x = 1e6 * verify::sticking_pair_limit(), .text = "limit of a sticking pair"}};
    return chart;
}

std::string single_contact_text(const SingleContactResult& result) {
    return fmt::format("{}\n{}\n{}\n",
                       text_of(orders_table(result)),
                       text_of(errors_table(result)),
                       finding(result));
}

void write_single_contact_folder(const SingleContactResult& result,
                                 const StudyOrigin& origin,
                                 const std::filesystem::path& folder) {
    io::make_folder(folder);
    const render::ChartProvenance provenance{{"Software", "grainbench " + build_info().version},
                                             {"Source", origin.command}};
    std::string images;
    std::string figures;
    const auto draw = [&](const Chart& chart, const std::string& stem, const std::string& what) {
        render::write_chart(chart, folder / stem, provenance);
        images += fmt::format("<p><img src=\"{}.svg\" alt=\"{}\"></p>\n", stem, what);
        figures += fmt::format("![{}]({}.svg)\n\n", what, stem);
    };
    draw(step_chart(result), "step", "energy error against step");
    draw(outcomes_chart(result), "outcomes", "errors against steps per contact");
    draw(work_chart(result, Outcome::restitution), "restitution", "error of the restitution");
    draw(work_chart(result, Outcome::turning), "spin", "error of the exit spin");
    io::write_file(folder / "single-contact.csv", csv_of(result));
    io::write_file(
        folder / "single-contact.md",
        fmt::format("# One contact: what steps buy\n\n{}\n\n{}\n{}\n{}\n\n{}\n\n{}Made by "
                    "`{}`.\n",
                    explanation,
                    markdown_of(orders_table(result)),
                    markdown_of(errors_table(result)),
                    step_explanation,
                    finding(result),
                    figures,
                    origin.command));
    io::write_file(
        folder / "index.html",
        fmt::format("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                    "<title>One contact: what steps buy</title>\n</head>\n<body>\n<h1>One contact: "
                    "what steps buy</h1>\n<p>{}</p>\n{}\n{}<p>{}</p>\n<p>{}</p>\n{}<p>Made by "
                    "<code>{}</code>.</p>\n</body>\n</html>\n",
                    explanation,
                    html_of(orders_table(result)),
                    html_of(errors_table(result)),
                    step_explanation,
                    html_escaped(finding(result)),
                    images,
                    html_escaped(origin.command)));
}

}  // namespace grainbench::cli
