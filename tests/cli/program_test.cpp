#include "tests/cli/invoke.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace grainbench::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;

TEST(Program, HelpListsTheCommandsAndEachShowsAnExample) {
    const Answer help = invoke({"--help"});
    EXPECT_EQ(help.code, 0);
    EXPECT_THAT(help.err, IsEmpty());
    for (const std::string command :
         {"run", "check", "render", "figures", "export", "compare", "doctor", "schema"}) {
        EXPECT_THAT(help.out, HasSubstr("\n  " + command + " "));
        const Answer answer = invoke({command, "--help"});
        EXPECT_EQ(answer.code, 0) << command;
        EXPECT_THAT(answer.out, HasSubstr("Example:\n  grainbench " + command)) << command;
    }
}

TEST(Program, VersionHasNumberAndCommit) {
    const Answer answer = invoke({"--version"});
    EXPECT_EQ(answer.code, 0);
    EXPECT_THAT(answer.out,
                MatchesRegex("grainbench [0-9]+\\.[0-9]+\\.[0-9]+ "
                             "\\((unknown|[0-9a-f]+(-dirty)?)\\)\n"));
}

TEST(Program, WrongUsageExitsWithTwoAndSaysWhatToDo) {
    const struct {
        std::vector<std::string> arguments;
        std::string said;
    } cases[] = {
        {{}, "--help"},
        {{"rnu"}, "did you mean run instead of rnu?"},
        {{"chek", "scene.json"}, "did you mean check instead of chek?"},
        {{"--versoin"}, "did you mean --version instead of --versoin?"},
        {{"run"}, "SCENE is required"},
        {{"run", "a.json", "--resme"}, "did you mean --resume instead of --resme?"},
        {{"run", "a.json", "b.json"}, "b.json"},
        {{"run", "a.json", "--threads", "0"}, "--threads"},
        {{"run", "a.json", "--threads", "many"}, "--threads"},
        {{"export", "run", "--format", "stl"}, "--format"},
        {{"schema", "scenery"}, "scenery not in {scene,"},
    };

    for (const auto& [arguments, said] : cases) {
        const Answer answer = invoke(arguments);
        EXPECT_EQ(answer.code, 2) << said;
        EXPECT_THAT(answer.out, IsEmpty());
        EXPECT_THAT(answer.err,
                    AllOf(HasSubstr("grainbench: "), HasSubstr(said), HasSubstr("next step: ")));
    }
}

TEST(Program, OutputThatCannotBeWrittenExitsWithFive) {
    std::ostringstream out;
    std::ostringstream err;
    out.setstate(std::ios::badbit);
    EXPECT_EQ(run_program({"schema", "scene"}, {.out = out, .err = err}), 5);
    EXPECT_THAT(err.str(), HasSubstr("stdout"));
}

TEST(Program, UnexpectedFailureExitsWithOneAndAsksForAReport) {
    /// Throws what no command reckons with.
    class Trap : public std::stringbuf {
        std::streamsize xsputn(const char*, std::streamsize) override {
            throw std::logic_error("trapped");
        }
    };

    Trap trap;
    std::ostream out(&trap);
    out.exceptions(std::ios::badbit);
    std::ostringstream err;
    EXPECT_EQ(run_program({"schema", "scene"}, {.out = out, .err = err}), 1);
    EXPECT_THAT(err.str(), AllOf(HasSubstr("internal error: trapped"), HasSubstr("please report")));
}

}  // namespace
}  // namespace grainbench::cli
