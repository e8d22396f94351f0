#include "cli/verify_command.hpp"

#include "core/error.hpp"
#include "core/verify/registry.hpp"

#include "io/atomic_file.hpp"

#include "cli/exit_codes.hpp"
#include "cli/verify_report.hpp"

#include <algorithm>
#include <limits>
#include <regex>

namespace grainbench::cli {
namespace {

std::regex compile(const std::string& filter) {
    try {
        return std::regex(filter, std::regex::ECMAScript);
    } catch (const std::regex_error& error) {
        throw_bad_input({.what = "'" + filter + "' is no regular expression: " + error.what(),
                         .where = "--filter",
                         .likely_cause = "a bracket without its partner, or a bare * or +",
                         .next_step = "try a plain part of a name, such as --filter impact"});
    }
}

std::vector<verify::Case> chosen_cases(const std::string& filter) {
    const std::regex expression = compile(filter);
    std::vector<verify::Case> chosen;
    for (const verify::Case& one : verify::all_cases()) {
        if (std::regex_search(one.name, expression)) {
            chosen.push_back(one);
        }
    }
    if (chosen.empty()) {
        throw_bad_input({.what = "no case has a name that matches '" + filter + "'",
                         .where = "--filter",
                         .likely_cause = "a misspelt name",
                         .next_step = "`grainbench verify` prints all names"});
    }
    return chosen;
}

/// A case that the engine stops has failed; the others still run.
CaseResult result_of(const verify::Case& one, bool full) {
    try {
        return {.one = one, .checks = verify::checks_of(one, full)};
    } catch (const Error& error) {
        return {.one = one,
                .checks = {{.case_name = one.name,
                            .quantity = "runs to its end",
                            .unit = "1",
                            .expected = 1.0,
                            .got = std::numeric_limits<double>::quiet_NaN(),
                            .tolerance = 0.0,
                            .reason = error.diagnosis().what}}};
    }
}

}  // namespace

int verify_command(const VerifyArguments& arguments, const Streams& streams) {
    std::vector<CaseResult> results;
    for (const verify::Case& one : chosen_cases(arguments.filter)) {
        results.push_back(result_of(one, arguments.full));
    }
    const std::string json = verify_json(results);
    if (!arguments.folder.empty()) {
        io::make_folder(arguments.folder);
        io::write_file(arguments.folder / "verify.json", json);
        io::write_file(arguments.folder / "verify.md", verify_markdown(results));
        io::write_file(arguments.folder / "verify.xml", verify_junit(results));
    }
    streams.out << (arguments.json ? json : verify_text(results));
    const bool pass = std::all_of(
        results.begin(), results.end(), [](const CaseResult& result) { return result.passes(); });
    return pass ? exit_ok : exit_check_failed;
}

}  // namespace grainbench::cli
