#include "cli/figures/figure_index.hpp"

#include <fmt/format.h>

namespace grainbench::cli {
namespace {

/// Text as it may stand in HTML, in attributes too.
std::string html(const std::string& text) {
    std::string escaped;
    for (const char c : text) {
        switch (c) {
            case '&':
                escaped += "&amp;";
                break;
            case '<':
                escaped += "&lt;";
                break;
            case '>':
                escaped += "&gt;";
                break;
            case '"':
                escaped += "&quot;";
                break;
            default:
                escaped += c;
        }
    }
    return escaped;
}

/// Text as a cell of a Markdown table.
std::string cell(const std::string& text) {
    std::string escaped;
    for (const char c : text) {
        escaped += c == '|' ? "\\|" : c == '\n' ? std::string(" ") : std::string(1, c);
    }
    return escaped;
}

constexpr std::string_view quick_note =
    "Made with --quick: the runs are shortened, and their figures show that everything works, not "
    "what the full runs show.";

constexpr std::string_view style = R"(
body { font: 16px/1.5 sans-serif; max-width: 70rem; margin: 2rem auto; padding: 0 1rem; color: #222; }
figure { margin: 2.5rem 0; }
.pictures { display: flex; flex-wrap: wrap; gap: 0.8rem; }
.pictures div { flex: 1 1 30rem; text-align: center; font-size: 0.9rem; }
.many div { flex-basis: 20rem; }
img { max-width: 100%; height: auto; border: 1px solid #ddd; }
figcaption { margin-top: 0.5rem; }
table { border-collapse: collapse; font-size: 0.9rem; }
th, td { padding: 0.2rem 0.7rem; text-align: left; border-bottom: 1px solid #ddd; vertical-align: top; }
td.number { text-align: right; font-variant-numeric: tabular-nums; }
.note { background: #fff4d6; padding: 0.5rem 1rem; }
)";

std::string html_figure(const IndexFigure& figure) {
    std::string text = fmt::format("<figure id=\"{}\">\n<div class=\"pictures{}\">\n",
                                   html(figure.name),
                                   figure.pictures.size() > 2 ? " many" : "");
    for (const IndexPicture& picture : figure.pictures) {
        text += fmt::format("<div><a href=\"{0}\"><img src=\"{0}\" alt=\"{1}\"></a>{2}</div>\n",
                            html(picture.file),
                            html(figure.caption),
                            picture.note.empty() ? "" : "<br>" + html(picture.note));
    }
    text +=
        fmt::format("</div>\n<figcaption><b>{}</b> {}", html(figure.name), html(figure.caption));
    for (const std::string& file : figure.files) {
        text += fmt::format(
            " <a href=\"{0}\">{1}</a>", html(file), html(file.substr(file.rfind('.') + 1)));
    }
    return text + "</figcaption>\n</figure>\n";
}

std::string html_run(const IndexRun& run) {
    return fmt::format(
        "<tr><td><a href=\"{}/manifest.json\">{}</a></td><td>{}</td><td>{}</td>"
        "<td class=\"number\">{:.4g}</td><td class=\"number\">{}</td><td class=\"number\">{}</td>"
        "<td class=\"number\">{}</td><td class=\"number\">{:.1f}</td></tr>\n",
        html(run.folder),
        html(run.name),
        html(run.scene),
        html(run.outcome),
        run.time,
        run.realisations,
        run.particles,
        run.cycles,
        run.cpu_seconds);
}

}  // namespace

std::string to_html(const FigureIndex& index) {
    std::string text = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n<h1>{0}</h1>\n<p>{2}</p>\n",
        html(index.title),
        style,
        html(index.description));
    if (index.is_quick) {
        text += fmt::format("<p class=\"note\">{}</p>\n", quick_note);
    }
    for (const IndexFigure& figure : index.figures) {
        text += html_figure(figure);
    }
    text +=
        "<h2>Runs</h2>\n<table>\n<tr><th>run</th><th>scene</th><th>outcome</th><th>time [s]</th>"
        "<th>realisations</th><th>particles</th><th>cycles</th><th>processor [s]</th></tr>\n";
    for (const IndexRun& run : index.runs) {
        text += html_run(run);
    }
    text +=
        fmt::format("</table>\n<p>{} on {}. Made again by <code>{}</code>.</p>\n</body>\n</html>\n",
                    html(index.program),
                    html(index.machine),
                    html(index.command));
    return text;
}

std::string to_markdown(const FigureIndex& index) {
    std::string text = fmt::format("# {}\n\n{}\n", index.title, index.description);
    if (index.is_quick) {
        text += fmt::format("\n{}\n", quick_note);
    }
    for (const IndexFigure& figure : index.figures) {
        text += fmt::format("\n## {}\n\n", figure.name);
        for (const IndexPicture& picture : figure.pictures) {
            text += fmt::format("![{}]({})\n", picture.note, picture.file);
        }
        text += fmt::format("\n{}", figure.caption);
        for (const std::string& file : figure.files) {
            text += fmt::format(" [{}]({})", file.substr(file.rfind('.') + 1), file);
        }
        text += "\n";
    }
    text +=
        "\n## Runs\n\n| run | scene | outcome | time [s] | realisations | particles | cycles | "
        "processor [s] |\n|---|---|---|---|---|---|---|---|\n";
    for (const IndexRun& run : index.runs) {
        text +=
            fmt::format("| [{}]({}/manifest.json) | {} | {} | {:.4g} | {} | {} | {} | {:.1f} |\n",
                        cell(run.name),
                        run.folder,
                        cell(run.scene),
                        cell(run.outcome),
                        run.time,
                        run.realisations,
                        run.particles,
                        run.cycles,
                        run.cpu_seconds);
    }
    text += fmt::format(
        "\n{} on {}. Made again by `{}`.\n", index.program, index.machine, index.command);
    return text;
}

}  // namespace grainbench::cli
