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
#include <chrono>
#include <limits>
#include <numeric>

namespace grainbench::cli {
namespace {

namespace fs = std::filesystem;

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

/// The look of a file that names its run.
RenderJob job_of_order(const fs::path& file, const std::vector<std::string>& overrides) {
    RenderJob job{.run = {},
                  .look = render::read_look(file, overrides),
                  .name = file.stem().string(),
                  .folder = {}};
    if (job.look.run.empty()) {
        throw_bad_input(
            {.what = "the look names no run folder",
             .where = file.string() + ", /run",
             .likely_cause = "it is a look for any run",
             .next_step = fmt::format("grainbench render RUN_DIR --look {}", file.string())});
    }
    job.run = job.look.run;
    return job;
}

RenderJob job_of(const RenderArguments& arguments) {
    std::vector<std::string> overrides = arguments.overrides;
    if (!arguments.size.empty()) {
        add_size(arguments.size, overrides);
    }
    RenderJob job;
    if (arguments.source.extension() == ".json") {
        if (!arguments.look.empty()) {
            throw_usage("a look file and --look are two looks",
                        "hand in a run folder with --look, or one look that names its run");
        }
        job = job_of_order(arguments.source, overrides);
    } else {
        job.run = arguments.source;
        const bool is_default = arguments.look.empty();
        job.look = is_default ? render::default_look(render::run_has_layers(job.run), overrides)
                              : render::read_look(arguments.look, overrides);
        job.name = is_default ? "particles" : arguments.look.stem().string();
    }
    if (!arguments.times.empty()) {
        job.look.times.clear();
        for (const std::string& text : arguments.times) {
            job.look.times.push_back(time_of(text));
        }
    }
    job.folder = arguments.folder.empty() ? job.run / "pictures" : arguments.folder;
    return job;
}

/// Numbers of the frames to draw.
std::vector<std::size_t> frames_of(const render::SnapshotPainter& painter,
                                   const render::Look& look) {
    std::vector<std::size_t> frames;
    for (const double time : look.times) {
        frames.push_back(painter.nearest(time));
    }
    if (look.times.empty()) {
        frames.resize(painter.times().size());
        std::iota(frames.begin(), frames.end(), 0);
    }
    return frames;
}

}  // namespace

RenderJob job_of_look(const fs::path& run, const fs::path& look) {
    return {.run = run,
            .look = render::read_look(look),
            .name = look.stem().string(),
            .folder = run / "pictures"};
}

void draw_pictures(const RenderJob& job,
                   const std::function<void(const fs::path&, std::size_t)>& on_picture) {
    const BuildInfo build = build_info();
    render::SnapshotPainter painter(
        job.run, job.look, fmt::format("grainbench {} ({})", build.version, build.git_hash));
    const std::vector<std::size_t> frames = frames_of(painter, job.look);
    io::make_folder(job.folder);
    for (const std::size_t frame : frames) {
        const fs::path file = job.folder / fmt::format("{}_{}.png", job.name, io::padded(frame));
        const render::Snapshot snapshot = painter.draw(frame);
        render::write_png(file, snapshot.image, snapshot.text);
        on_picture(file, frames.size());
    }
}

int render_command(const RenderArguments& arguments, const Streams& streams) {
    const RenderJob job = job_of(arguments);
    std::size_t done = 0;
    const auto start = std::chrono::steady_clock::now();
    draw_pictures(job, [&](const fs::path& file, std::size_t count) {
        streams.out << file.string() << "\n";
        ++done;
        if (!arguments.quiet && streams.err_is_terminal) {
            streams.err << fmt::format("\r{} of {} pictures ", done, count);
        }
    });
    if (!arguments.quiet) {
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
        streams.err << fmt::format("{}{} {} in {}, {:.2f} s each\n",
                                   streams.err_is_terminal ? "\r" : "",
                                   done,
                                   done == 1 ? "picture" : "pictures",
                                   job.folder.string(),
                                   spent.count() / static_cast<double>(done));
    }
    return exit_ok;
}

}  // namespace grainbench::cli
