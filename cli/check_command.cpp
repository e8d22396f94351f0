#include "cli/check_command.hpp"

#include "io/json/scene_json.hpp"

#include "cli/check_report.hpp"
#include "cli/exit_codes.hpp"

namespace grainbench::cli {

int check_command(const CheckArguments& arguments, const Streams& streams) {
    const Scene scene = io::read_scene(arguments.scene, arguments.overrides);
    const io::CheckReport report = check_scene(scene, arguments.trial_seconds);
    streams.out << (arguments.json ? io::to_json(report, io::write_scene(scene))
                                   : check_text(scene, report));
    return exit_ok;
}

}  // namespace grainbench::cli
