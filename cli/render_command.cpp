#include "cli/render_command.hpp"

#include "core/error.hpp"

#include "io/atomic_file.hpp"
#include "io/text.hpp"

#include "render/look_json.hpp"
#include "render/snapshot.hpp"

#include "cli/build_info.hpp"
#include "cli/exit_codes.hpp"

#include <fmt/format.h>

#include <charconv>
#include <limits>

namespace grainbench::cli {
namespace {

namespace fs = std::filesystem;

/// What is to be drawn, and how its files are called.
struct Job {
    fs::path run;
    render::Look look;
    std::string name;
};

[[noreturn]] void throw_usage(const std::string& what, const std::string& next_step) {
    throw_bad_input({.what = what,
                     .where = "command line",
                     .likely_cause = "a slip of the keys",
                     .next_step = next_step});
}

/// Turns "1600x1000" into changes of the look.
void add_size(const std::string& size, std::vector<std::string>& overrides) {
    const std::size_t cross = size.find('x');
    const bool is_size = cross != std::string::npos && cross > 0 && cross + 1 < size.size() &&
                         size.find_first_not_of("0123456789x") == std::string::npos &&
                         size.find('x', cross + 1) == std::string::npos;
    if (!is_size) {
        throw_usage(fmt::format("'{}' is no size of a picture", size),
                    "write width and height in pixels, as in 1600x1000");
    }
    overrides.push_back("/width=" + size.substr(0, cross));
    overrides.push_back("/height=" + size.substr(cross + 1));
}

double time_of(const std::string& text) {
    if (text == "first" || text == "last") {
        const double infinity = std::numeric_limits<double>::infinity();
        return text == "first" ? -infinity : infinity;
    }
    double time = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), time);
    if (error != std::errc{} || end != text.data() + text.size()) {
        throw_usage(fmt::format("'{}' is no time", text), "write seconds, 'first' or 'last'");
    }
    return time;
}

Job job_of(const RenderArguments& arguments) {
    std::vector<std::string> overrides = arguments.overrides;
    if (!arguments.size.empty()) {
        add_size(arguments.size, overrides);
    }
    if (arguments.source.extension() == ".json") {
        if (!arguments.look.empty()) {
            throw_usage("a look file and --look are two looks",
                        "hand in a run folder with --look, or one look that names its run");
        }
        Job job{{}, render::read_look(arguments.source, overrides), {}};
        job.run = job.look.run;
        job.name = arguments.source.stem().string();
        if (job.run.empty()) {
            throw_bad_input({.what = "the look names no run folder",
                             .where = arguments.source.string() + ", /run",
                             .likely_cause = "it is a look for any run",
                             .next_step = fmt::format("grainbench render RUN_DIR --look {}",
                                                      arguments.source.string())});
        }
        return job;
    }
    if (arguments.look.empty()) {
        return {arguments.source,
                render::default_look(render::run_has_layers(arguments.source), overrides),
                "particles"};
    }
    return {arguments.source,
            render::read_look(arguments.look, overrides),
            arguments.look.stem().string()};
}

/// Numbers of the frames to draw.
std::vector<std::size_t> frames_of(const render::SnapshotPainter& painter,
                                   const RenderArguments& arguments,
                                   const render::Look& look) {
    std::vector<double> times = look.times;
    if (!arguments.times.empty()) {
        times.clear();
        for (const std::string& text : arguments.times) {
            times.push_back(time_of(text));
        }
    }
    std::vector<std::size_t> frames;
    for (const double time : times) {
        frames.push_back(painter.nearest(time));
    }
    if (times.empty()) {
        for (std::size_t frame = 0; frame < painter.times().size(); ++frame) {
            frames.push_back(frame);
        }
    }
    return frames;
}

}  // namespace

int render_command(const RenderArguments& arguments, const Streams& streams) {
    const Job job = job_of(arguments);
    const BuildInfo build = build_info();
    render::SnapshotPainter painter(
        job.run, job.look, fmt::format("grainbench {} ({})", build.version, build.git_hash));
    const std::vector<std::size_t> frames = frames_of(painter, arguments, job.look);
    const fs::path folder = arguments.folder.empty() ? job.run / "pictures" : arguments.folder;
    io::make_folder(folder);
    for (std::size_t k = 0; k < frames.size(); ++k) {
        const fs::path file = folder / fmt::format("{}_{}.png", job.name, io::padded(frames[k]));
        const render::Snapshot snapshot = painter.draw(frames[k]);
        render::write_png(file, snapshot.image, snapshot.text);
        streams.out << file.string() << "\n";
        if (!arguments.quiet && streams.err_is_terminal) {
            streams.err << fmt::format("\r{} of {} pictures ", k + 1, frames.size());
        }
    }
    if (!arguments.quiet) {
        streams.err << fmt::format("{}{} pictures in {}\n",
                                   streams.err_is_terminal ? "\r" : "",
                                   frames.size(),
                                   folder.string());
    }
    return exit_ok;
}

}  // namespace grainbench::cli
