#include "cli/study/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace grainbench::cli {

std::string text_of(const Table& table) {
    std::vector<std::size_t> widths;
    for (std::size_t column = 0; column < table.header.size(); ++column) {
        std::size_t width = table.header[column].size();
        for (const std::vector<std::string>& row : table.rows) {
            width = std::max(width, row[column].size());
        }
        widths.push_back(width);
    }
    const auto line = [&](const std::vector<std::string>& cells) {
        std::string text = fmt::format("{:<{}}", cells[0], widths[0]);
        for (std::size_t column = 1; column < cells.size(); ++column) {
            text += fmt::format("  {:>{}}", cells[column], widths[column]);
        }
        return text + "\n";
    };
    std::string text = line(table.header);
    for (const std::vector<std::string>& row : table.rows) {
        text += line(row);
    }
    return text;
}

std::string markdown_of(const Table& table) {
    const auto line = [](std::vector<std::string> cells) {
        for (std::string& cell : cells) {
            for (std::size_t k = cell.find('|'); k != std::string::npos;
                 k = cell.find('|', k + 2)) {
                cell.insert(k, 1, '\\');
            }
        }
        return fmt::format("| {} |\n", fmt::join(cells, " | "));
    };
    std::string text = line(table.header) + "|";
    for (std::size_t column = 0; column < table.header.size(); ++column) {
        text += column == 0 ? "---|" : "---:|";
    }
    text += "\n";
    for (const std::vector<std::string>& row : table.rows) {
        text += line(row);
    }
    return text;
}

std::string html_escaped(const std::string& text) {
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

std::string html_of(const Table& table) {
    const auto line = [](const std::vector<std::string>& cells, const char* tag) {
        std::string text = "<tr>";
        for (const std::string& cell : cells) {
            text += fmt::format("<{}>{}</{}>", tag, html_escaped(cell), tag);
        }
        return text + "</tr>\n";
    };
    std::string text = "<table>\n" + line(table.header, "th");
    for (const std::vector<std::string>& row : table.rows) {
        text += line(row, "td");
    }
    return text + "</table>\n";
}

}  // namespace grainbench::cli
