/// `grainbench render`: pictures of the particles of a run.
#pragma once

#include "render/look.hpp"

#include "cli/streams.hpp"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace grainbench::cli {

struct RenderArguments {
    std::filesystem::path source;        ///< run folder, or a look that names one
    std::filesystem::path folder;        ///< for the pictures; empty = `pictures` in the run folder
    std::filesystem::path look;          ///< empty = the default look
    std::vector<std::string> times;      ///< numbers, "first" or "last"; empty = as the look says
    std::string size;                    ///< "1600x1000"; empty = as the look says
    std::vector<std::string> overrides;  ///< "/json/pointer=value" for the look
    bool quiet = false;
};

/// What is to be drawn, and how the files are called: NAME_000000.png for frame 0.
struct RenderJob {
    std::filesystem::path run;
    render::Look look;
    std::string name;
    std::filesystem::path folder;
};

/// Every frame of a run by the look of a file, into `pictures` in the run folder.
RenderJob job_of_look(const std::filesystem::path& run, const std::filesystem::path& look);

/// Draws the frames that the look asks for.
/// \param on_picture is told the path of each picture when it is written, and how many there are
void draw_pictures(
    const RenderJob& job,
    const std::function<void(const std::filesystem::path&, std::size_t)>& on_picture);

/// Prints the path of each picture when it is written.
int render_command(const RenderArguments& arguments, const Streams& streams);

}  // namespace grainbench::cli
