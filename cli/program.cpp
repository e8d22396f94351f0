#include "cli/program.hpp"

#include "core/error.hpp"

#include "io/json/problems.hpp"

#include "cli/bench_command.hpp"
#include "cli/build_info.hpp"
#include "cli/check_command.hpp"
#include "cli/compare_command.hpp"
#include "cli/doctor_command.hpp"
#include "cli/exit_codes.hpp"
#include "cli/export_command.hpp"
#include "cli/figures_command.hpp"
#include "cli/render_command.hpp"
#include "cli/run_command.hpp"
#include "cli/schema_command.hpp"
#include "cli/study_command.hpp"
#include "cli/verify_command.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <functional>
#include <map>
#include <new>

namespace grainbench::cli {
namespace {

/// The command line and the command that it asks for. A new command adds one function here, called
/// in the constructor, and one pair of files.
class Program {
public:
    explicit Program(const Streams& streams)
        : streams_(streams), app_("Headless workbench for granular flow.", "grainbench") {
        const BuildInfo build = build_info();
        app_.set_version_flag("--version",
                              "grainbench " + build.version + " (" + build.git_hash + ")",
                              "Print version");
        app_.require_subcommand(1);
        app_.footer("Data goes to stdout, talk to stderr. `grainbench COMMAND --help` tells more.");
        add_run();
        add_check();
        add_render();
        add_export();
        add_figures();
        add_compare();
        add_doctor();
        add_schema();
        add_verify();
        add_bench();
        add_study();
    }

    /// \param arguments in reverse order, as CLI11 wants them
    int execute(std::vector<std::string> arguments) {
        try {
            app_.parse(std::move(arguments));
        } catch (const CLI::ParseError& error) {
            if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
                app_.exit(error, streams_.out, streams_.err);
                return exit_ok;
            }
            streams_.err << usage_error(error);
            return exit_bad_input;
        }
        return command_();
    }

private:
    void add_run() {
        CLI::App* sub = app_.add_subcommand("run", "Run a scene into a run folder");
        sub->add_option("SCENE", run_.scene, "Scene file (JSON)")->required();
        sub->add_option(
            "-o,--output", run_.folder, "Run folder; out/<name of the scene> if absent");
        add_overrides(*sub, run_.overrides);
        sub->add_option(
               "--threads",
               run_.threads,
               "Realisations side by side, or shares of a large one; all processors if absent")
            ->check(CLI::Range(1U, 4096U));
        sub->add_flag("--resume", run_.resume, "Go on from the checkpoint of the run folder");
        sub->add_flag("--quiet", run_.quiet, "No talk but errors");
        sub->add_flag("--json", run_.json, "Print the manifest of the run");
        sub->add_flag("--history-csv", run_.history_csv, "Write history.csv as well");
        sub->add_option(
            "--look", run_.look, "Draw every frame in the end, as `render --look` does");
        finish(*sub,
               "grainbench run presets/scenes/bne-quick.json -o out/first"
               " --set /contact/friction/coefficient=0.3",
               [this] { return run_command(run_, streams_); });
    }

    void add_check() {
        CLI::App* sub = app_.add_subcommand("check", "Say what a scene asks for and will cost");
        sub->add_option("SCENE", check_.scene, "Scene file (JSON)")->required();
        add_overrides(*sub, check_.overrides);
        sub->add_flag("--json", check_.json, "Print the numbers and the effective scene as JSON");
        finish(*sub,
               "grainbench check presets/scenes/bne.json --set /timestep/safety_factor=0.5",
               [this] { return check_command(check_, streams_); });
    }

    void add_render() {
        CLI::App* sub = app_.add_subcommand("render", "Draw the particles of a run");
        sub->add_option("SOURCE", render_.source, "Run folder, or a look that names one")
            ->required()
            ->type_name("RUN_DIR|SPEC.json");
        sub->add_option(
            "-o,--output", render_.folder, "Folder for the pictures; RUN_DIR/pictures if absent");
        sub->add_option("--look", render_.look, "How to draw: a file as in presets/render");
        take_one_each(sub->add_option("--time",
                                      render_.times,
                                      "Draw the frame nearest to this; may be repeated"))
            ->type_name("SECONDS|first|last");
        sub->add_option("--size", render_.size, "Pixels")->type_name("WIDTHxHEIGHT");
        take_one_each(sub->add_option("--set",
                                      render_.overrides,
                                      "Change the look: /json/pointer=value; may be repeated"))
            ->type_name("POINTER=VALUE");
        sub->add_flag("--quiet", render_.quiet, "No talk but errors");
        finish(*sub,
               "grainbench render out/bne-quick --look presets/render/top-layer.json --time 6",
               [this] { return render_command(render_, streams_); });
    }

    void add_export() {
        CLI::App* sub =
            app_.add_subcommand("export", "Write the frames of a run in another format");
        sub->add_option("RUN_DIR", export_.run, "Run folder")->required();
        std::map<std::string, io::ExportFormat> formats;
        for (const auto& [format, name] : EnumNames<io::ExportFormat>::value) {
            formats.emplace(name, format);
        }
        sub->add_option("--format", export_.format, "vtu, vtp or csv")
            ->required()
            ->transform(CLI::CheckedTransformer(formats))
            ->type_name("FORMAT");
        sub->add_option("-o,--output", export_.folder, "Folder; RUN_DIR-FORMAT if absent");
        finish(*sub, "grainbench export out/bne-quick --format csv -o out/tables", [this] {
            return export_command(export_, streams_);
        });
    }

    void add_figures() {
        CLI::App* sub = app_.add_subcommand("figures", "Run and draw a set of figures");
        sub->add_option("SET", figures_.set, "Set of figures (JSON)")->required();
        sub->add_option("-o,--output", figures_.folder, "Folder; out/<name of the set> if absent");
        sub->add_flag("--quick", figures_.quick, "Runs shortened as the set says, for a look");
        sub->add_option(
               "--jobs", figures_.jobs, "Realisations side by side; all processors if absent")
            ->check(CLI::Range(1U, 4096U));
        sub->add_flag("--quiet", figures_.quiet, "No talk but errors");
        finish(*sub, "grainbench figures presets/figures/bne.json --quick", [this] {
            return figures_command(figures_, streams_);
        });
    }

    void add_compare() {
        CLI::App* sub = app_.add_subcommand(
            "compare", "Say how alike two pictures, bench results or run folders are");
        sub->add_option("A", compare_.first, "PNG file, bench result (.json) or run folder")
            ->required();
        sub->add_option("B", compare_.second, "Another of the same kind")->required();
        sub->add_option(
            "-o,--output", compare_.difference, "PNG file that shows where pictures differ");
        sub->add_option("--threshold",
                        compare_.threshold,
                        "Exit code 4 if more: 1 - SSIM of pictures (0.02 if absent), growth of a "
                        "time (0.1), relative deviation of a history (0: the same bits)")
            ->check(CLI::Range(0.0, 2.0));
        sub->add_flag("--json", compare_.json, "Print JSON in place of text");
        finish(*sub, "grainbench compare baseline.png new.png -o difference.png", [this] {
            return compare_command(compare_, streams_);
        });
    }

    void add_doctor() {
        CLI::App* sub =
            app_.add_subcommand("doctor", "Print versions, processor and libraries; try to draw");
        finish(*sub, "grainbench doctor", [this] { return doctor_command({}, streams_); });
    }

    void add_schema() {
        CLI::App* sub = app_.add_subcommand("schema", "Print what a file may hold");
        sub->add_option("KIND", schema_.kind, "Kind of file")
            ->required()
            ->check(CLI::IsMember(schema_kinds()));
        sub->add_flag("--markdown", schema_.markdown, "A page to read instead of JSON Schema");
        finish(*sub, "grainbench schema scene > scene.schema.json", [this] {
            return schema_command(schema_, streams_);
        });
    }

    void add_verify() {
        CLI::App* sub = app_.add_subcommand(
            "verify", "Run the cases with a known answer and print what they give");
        sub->add_option("--filter", verify_.filter, "Only cases whose name holds this")
            ->type_name("REGEX");
        sub->add_flag("--json", verify_.json, "Print JSON in place of the table");
        sub->add_option(
            "-o,--output", verify_.folder, "Folder that gets verify.json, .md and .xml (JUnit)");
        sub->add_flag("--full", verify_.full, "The long series of the stability cases: minutes");
        finish(*sub, "grainbench verify --filter impact", [this] {
            return verify_command(verify_, streams_);
        });
    }

    void add_bench() {
        CLI::App* sub =
            app_.add_subcommand("bench", "Time what a particle-step costs on this machine");
        sub->add_option("--filter", bench_.filter, "Only benchmarks whose name holds this")
            ->type_name("REGEX");
        sub->add_flag("--json", bench_.json, "Print JSON in place of the table");
        sub->add_option("-o,--output", bench_.output, "File that gets the JSON as well");
        CLI::Option* threads =
            sub->add_option("--threads", bench_.threads, "Copies stepped side by side")
                ->check(CLI::PositiveNumber);
        sub->add_option("--scaling",
                        bench_.scaling,
                        "Threads that share each scene, compared with one thread")
            ->check(CLI::Range(2U, 4096U))
            ->excludes(threads);
        finish(*sub, "grainbench bench --filter shaken", [this] {
            return bench_command(
                bench_,
                {cpu_model(),
                 build_info().compiler,
                 build_info().flags,
                 "grainbench " + build_info().version + " (" + build_info().git_hash + ")"},
                streams_.out,
                streams_.err);
        });
    }

    void add_study() {
        CLI::App* sub = app_.add_subcommand(
            "study", "Compare settings of a scene: what accuracy costs in time");
        sub->add_option("STUDY", study_.study, "Study file (JSON)");
        sub->add_option("--suggest", study_.suggest, "Make and run a small study for this scene")
            ->type_name("SCENE");
        CLI::Option* single_contact =
            sub->add_flag("--single-contact",
                          study_.single_contact,
                          "How errors of one impact fall with the steps in it");
        CLI::Option* stability_map =
            sub->add_flag("--stability-map",
                          study_.stability_map,
                          "Which steps are stable, and what they do to the energy");
        sub->add_option("-o,--output",
                        study_.folder,
                        "Folder of the result; out/<name of the study> if absent");
        // Neither of the two has runs to keep, to share out or to print as JSON.
        sub->add_option(
               "--cache", study_.cache, "Folder of run folders to use again; DIR/runs if absent")
            ->excludes(single_contact)
            ->excludes(stability_map);
        sub->add_option("--threads", study_.threads, "Runs side by side; all processors if absent")
            ->check(CLI::Range(1U, 4096U))
            ->excludes(single_contact)
            ->excludes(stability_map);
        sub->add_flag("--quick", study_.quick, "A shortened study, to see that it runs")
            ->excludes(single_contact);
        sub->add_flag("--quiet", study_.quiet, "No talk but errors");
        sub->add_flag("--json", study_.json, "Print JSON in place of the table")
            ->excludes(single_contact)
            ->excludes(stability_map);
        finish(*sub, "grainbench study presets/studies/timestep.json --quick", [this] {
            return study_command(study_, streams_);
        });
    }

    /// Gives a command its example and what it does.
    void finish(CLI::App& sub, const std::string& example, std::function<int()> command) {
        sub.footer("Example:\n  " + example);
        sub.callback([this, command = std::move(command)] { command_ = command; });
    }

    static void add_overrides(CLI::App& sub, std::vector<std::string>& overrides) {
        take_one_each(sub.add_option("--set",
                                     overrides,
                                     "Change the scene: /json/pointer=value; may be repeated"))
            ->type_name("POINTER=VALUE");
    }

    /// One value, but the option may be given again.
    static CLI::Option* take_one_each(CLI::Option* option) {
        return option->expected(1)->take_all()->allow_extra_args(false);
    }

    /// The app whose arguments went wrong: the command, if one was named.
    const CLI::App& app_in_question() const {
        const auto chosen = app_.get_subcommands();
        return chosen.empty() ? app_ : *chosen.front();
    }

    std::string usage_error(const CLI::ParseError& error) const {
        const CLI::App& app = app_in_question();
        const std::vector<std::string> extras = app_.remaining(true);
        const bool is_command = &app == &app_ && !extras.empty();
        std::string text = "grainbench: ";
        if (is_command) {
            const char* kind = extras.front().starts_with("-") ? "option" : "command";
            text += std::string("there is no ") + kind + " '" + extras.front() + "'";
        } else {
            text += error.what();
        }
        text += "\n";
        for (const std::string& argument : extras) {
            const std::string_view nearest = nearest_argument(app, argument);
            if (!nearest.empty()) {
                text +=
                    "  did you mean " + std::string(nearest) + " instead of " + argument + "?\n";
            }
        }
        const std::string name = &app == &app_ ? "" : " " + app.get_name();
        return text + "  next step: `grainbench" + name + " --help` lists what there is\n";
    }

    static std::string_view nearest_argument(const CLI::App& app, const std::string& argument) {
        static std::vector<std::string> names;
        names.clear();
        if (argument.starts_with("-")) {
            for (const CLI::Option* option : app.get_options()) {
                for (const std::string& name : option->get_lnames()) {
                    names.push_back("--" + name);
                }
            }
        } else {
            for (const CLI::App* sub : app.get_subcommands(nullptr)) {
                names.push_back(sub->get_name());
            }
        }
        const std::vector<std::string_view> known(names.begin(), names.end());
        return io::nearest_name(argument.substr(0, argument.find('=')), known);
    }

    const Streams& streams_;
    CLI::App app_;
    std::function<int()> command_;
    RunArguments run_;
    CheckArguments check_;
    RenderArguments render_;
    ExportArguments export_;
    CompareArguments compare_;
    SchemaArguments schema_;
    FiguresArguments figures_;
    VerifyArguments verify_;
    BenchArguments bench_;
    StudyArguments study_;
};

int exit_code_of(ErrorKind kind) {
    switch (kind) {
        case ErrorKind::bad_input:
            return exit_bad_input;
        case ErrorKind::unstable:
            return exit_unstable;
        case ErrorKind::input_output:
            return exit_input_output;
    }
    return exit_internal;
}

int report_bug(const Streams& streams, const std::string& what) {
    streams.err << "grainbench: internal error: " << what
                << "\n  likely cause: a bug of grainbench\n  next step: please report it with the "
                   "command line, the scene and what `grainbench doctor` prints\n";
    return exit_internal;
}

}  // namespace

int run_program(std::vector<std::string> arguments, const Streams& streams) {
    try {
        std::reverse(arguments.begin(), arguments.end());
        const int code = Program(streams).execute(std::move(arguments));
        streams.out.flush();
        if (!streams.out) {
            throw_input_output({.what = "not all of the output could be written",
                                .where = "stdout",
                                .likely_cause = "the disk is full or the reader went away",
                                .next_step = "send the output elsewhere"});
        }
        return code;
    } catch (const Error& error) {
        streams.err << "grainbench: " << error.what() << "\n";
        return exit_code_of(error.kind());
    } catch (const std::bad_alloc&) {
        return report_bug(streams,
                          "no memory left; `grainbench check` estimates what a scene needs");
    } catch (const std::exception& error) {
        return report_bug(streams, error.what());
    }
}

}  // namespace grainbench::cli
