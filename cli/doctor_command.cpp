#include "cli/doctor_command.hpp"

#include "core/error.hpp"
#include "core/kernels/kernels.hpp"

#include "io/atomic_file.hpp"
#include "io/libraries.hpp"

#include "render/self_test.hpp"

#include "cli/build_info.hpp"
#include "cli/exit_codes.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <thread>

namespace grainbench::cli {
namespace {

std::string isa_text() {
    std::string names;
    for (std::size_t n = 0; !available_isa(n).empty(); ++n) {
        names += (n == 0 ? "" : ", ") + std::string(available_isa(n));
    }
    return fmt::format("{} of {}", kernels_for("").isa, names);
}

void write_and_read_back(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / fmt::format("grainbench-doctor-{}", getpid());
    const std::string text = "written by grainbench doctor\n";
    io::write_file(file, text);
    const std::string found = io::read_file(file);
    io::remove_file(file);
    if (found != text) {
        throw_input_output({.what = "a file does not hold what was written to it",
                            .where = file.string(),
                            .likely_cause = "a broken disk or file system",
                            .next_step = "set TMPDIR to another folder and try again"});
    }
}

}  // namespace

int doctor_command(const DoctorArguments& arguments, const Streams& streams) {
    const BuildInfo build = build_info();
    const auto line = [&](std::string_view name, std::string_view value) {
        streams.out << fmt::format("{:<16} {}\n", name, value);
    };
    line("grainbench", build.version);
    line("git", build.git_hash);
    line("compiler", build.compiler);
    line("build", build.build_type + ": " + build.flags);
    line("processor", cpu_model());
    line("instruction set", isa_text());
    line("threads", std::to_string(std::thread::hardware_concurrency()));
    for (const auto& [name, value] : io::loaded_libraries()) {
        line(name, value);
    }
    for (const auto& [name, value] : build.libraries) {
        line(name, value);
    }
    std::string trouble;
    try {
        line("draws with", render::test_drawing());
    } catch (const Error& error) {
        // The rest is worth knowing too, and all else works without.
        line("draws with", "nothing: " + error.diagnosis().likely_cause);
        trouble = error.what();
    }
    const std::filesystem::path folder =
        arguments.folder.empty() ? std::filesystem::temp_directory_path() : arguments.folder;
    write_and_read_back(folder);
    line("can write to", folder.string());
    if (!trouble.empty()) {
        streams.err << "grainbench: " << trouble << "\n";
        return exit_input_output;
    }
    return exit_ok;
}

}  // namespace grainbench::cli
