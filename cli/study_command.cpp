#include "cli/study_command.hpp"

#include "core/error.hpp"

#include "io/atomic_file.hpp"
#include "io/study.hpp"

#include "cli/build_info.hpp"
#include "cli/exit_codes.hpp"
#include "cli/interrupt.hpp"
#include "cli/jobs/job_pool.hpp"
#include "cli/study/report.hpp"
#include "cli/study/single_contact.hpp"
#include "cli/study/stability_map.hpp"
#include "cli/study/suggest.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <thread>

namespace grainbench::cli {
namespace {

std::filesystem::path file_of(const StudyArguments& arguments) {
    return arguments.suggest.empty() ? arguments.study : arguments.suggest;
}

std::filesystem::path folder_of(const StudyArguments& arguments) {
    if (!arguments.folder.empty()) {
        return arguments.folder;
    }
    std::string name = file_of(arguments).stem().string();
    name += arguments.suggest.empty() ? "" : "-study";
    name += arguments.quick ? "-quick" : "";
    return std::filesystem::path("out") / name;
}

StudyOrigin origin_of(const StudyArguments& arguments) {
    return {.command = fmt::format("grainbench study {}{}{}",
                                   arguments.suggest.empty() ? "" : "--suggest ",
                                   file_of(arguments).generic_string(),
                                   arguments.quick ? " --quick" : ""),
            .cpu = cpu_model(),
            .threads = arguments.threads > 0 ? arguments.threads
                                             : std::max(1U, std::thread::hardware_concurrency()),
            .date = fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)))};
}

void require_one_task(const StudyArguments& arguments) {
    const int tasks = (arguments.study.empty() ? 0 : 1) + (arguments.suggest.empty() ? 0 : 1) +
                      (arguments.single_contact ? 1 : 0) + (arguments.stability_map ? 1 : 0);
    if (tasks != 1) {
        throw_bad_input(
            {.what = tasks == 0 ? "no study was named" : "more than one study was asked for",
             .where = "grainbench study",
             .likely_cause = "STUDY.json, --suggest, --single-contact and --stability-map exclude "
                             "each other",
             .next_step = "name a study file, or --suggest SCENE.json, --single-contact or "
                          "--stability-map"});
    }
}

int run_single_contact(const StudyArguments& arguments, const Streams& streams) {
    const std::filesystem::path folder =
        arguments.folder.empty() ? std::filesystem::path("out/single-contact") : arguments.folder;
    StudyOrigin origin = origin_of(arguments);
    origin.command = "grainbench study --single-contact";
    const SingleContactResult result = study_single_contact();
    write_single_contact_folder(result, origin, folder);
    streams.out << single_contact_text(result);
    if (!arguments.quiet) {
        streams.err << fmt::format("written to {}\n", (folder / "index.html").string());
    }
    return exit_ok;
}

int run_stability_map(const StudyArguments& arguments, const Streams& streams) {
    const std::filesystem::path folder =
        arguments.folder.empty() ? std::filesystem::path("out/stability-map") : arguments.folder;
    StudyOrigin origin = origin_of(arguments);
    origin.command = arguments.quick ? "grainbench study --stability-map --quick"
                                     : "grainbench study --stability-map";
    const StabilityMapResult result = study_stability_map(arguments.quick);
    write_stability_map_folder(result, origin, folder);
    streams.out << stability_map_text(result);
    if (!arguments.quiet) {
        streams.err << fmt::format("written to {}\n", (folder / "stability-map.svg").string());
    }
    return exit_ok;
}

}  // namespace

int study_command(const StudyArguments& arguments, const Streams& streams) {
    require_one_task(arguments);
    if (arguments.single_contact) {
        return run_single_contact(arguments, streams);
    }
    if (arguments.stability_map) {
        return run_stability_map(arguments, streams);
    }
    const std::filesystem::path file = file_of(arguments);
    const io::Study study =
        arguments.suggest.empty() ? io::read_study(file) : suggested_study(file);
    StudyPlan plan = plan_study(study, file.parent_path(), arguments.quick);
    const std::filesystem::path folder = folder_of(arguments);
    if (!arguments.suggest.empty()) {
        io::make_folder(folder);
        io::write_file(folder / "suggested-study.json", io::write_study(study));
    }

    const Interrupt interrupt;
    const std::vector<JobResult> results =
        run_jobs(jobs_of(plan),
                 {.cache = arguments.cache.empty() ? folder / "runs" : arguments.cache,
                  .threads = arguments.threads,
                  .quiet = arguments.quiet},
                 interrupt.requested(),
                 streams);
    if (!all_ended(results)) {
        streams.err << "interrupted; the same command goes on from here\n";
        return exit_interrupted;
    }
    const StudyResult result = analyse_study(std::move(plan), results);
    const StudyOrigin origin = origin_of(arguments);
    write_study_folder(result, origin, folder);
    streams.out << (arguments.json ? study_json(result, origin) : study_text(result));
    if (!arguments.quiet) {
        streams.err << fmt::format("written to {}\n", (folder / "index.html").string());
    }
    return exit_ok;
}

}  // namespace grainbench::cli
