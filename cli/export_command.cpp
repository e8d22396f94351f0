#include "cli/export_command.hpp"

#include "cli/exit_codes.hpp"

#include <fmt/format.h>

namespace grainbench::cli {

int export_command(const ExportArguments& arguments, const Streams& streams) {
    std::filesystem::path target = arguments.folder;
    if (target.empty()) {
        // A trailing slash would put the ending into the run folder.
        target = arguments.run.has_filename() ? arguments.run : arguments.run.parent_path();
        target += fmt::format("-{}", name_of(arguments.format));
    }
    const std::size_t count = io::export_run(arguments.run, target, arguments.format);
    streams.err << fmt::format("{} files written to {}\n", count, target.string());
    return exit_ok;
}

}  // namespace grainbench::cli
