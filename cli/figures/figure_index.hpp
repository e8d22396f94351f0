/// The index page of a figure set: what is seen, what it was made of and what that cost, as HTML
/// and as Markdown. Both are made of the same entries and refer to files by relative names.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace grainbench::cli {

struct IndexPicture {
    std::string file;
    std::string note;  ///< below it, such as its time; may be empty
};

struct IndexFigure {
    std::string name;
    std::string caption;
    std::vector<IndexPicture> pictures;
    std::vector<std::string> files;  ///< the same as SVG, CSV, ...
};

struct IndexRun {
    std::string name;
    std::string scene;    ///< file, and what was changed of it
    std::string folder;   ///< of the run, relative to the page
    std::string outcome;  ///< "finished", or what stopped it
    double time = 0.0;    ///< [s] simulated
    int realisations = 0;
    std::uint64_t particles = 0;  ///< of all realisations
    std::uint64_t cycles = 0;     ///< of all realisations
    double cpu_seconds = 0.0;     ///< [s] of all realisations
};

struct FigureIndex {
    std::string title;
    std::string description;
    bool is_quick = false;
    std::vector<IndexFigure> figures;
    std::vector<IndexRun> runs;
    std::string program;  ///< name, version, hash
    std::string machine;  ///< processor
    std::string command;  ///< makes the page again
};

std::string to_html(const FigureIndex& index);
std::string to_markdown(const FigureIndex& index);

}  // namespace grainbench::cli
