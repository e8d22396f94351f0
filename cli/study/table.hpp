/// Small tables of text, for terminals, Markdown and HTML.
#pragma once

#include <string>
#include <vector>

namespace grainbench::cli {

struct Table {
    std::vector<std::string> header;
    std::vector<std::vector<std::string>> rows;  ///< as many cells as the header
};

/// Columns two blanks apart, the first left and the others right.
std::string text_of(const Table& table);

std::string markdown_of(const Table& table);

std::string html_of(const Table& table);

/// Text that may stand between tags.
std::string html_escaped(const std::string& text);

}  // namespace grainbench::cli
