#include "io/atomic_file.hpp"

#include "cli/doctor_command.hpp"

#include "tests/cli/invoke.hpp"
#include "tests/cli/scenes.hpp"
#include "tests/unit/io/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace grainbench::cli {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::StartsWith;

TEST(SchemaCommand, PrintsSchemaAndPage) {
    const Answer schema = invoke({"schema", "scene"});
    EXPECT_EQ(schema.code, 0);
    EXPECT_TRUE(nlohmann::json::parse(schema.out).contains("$schema"));
    const Answer page = invoke({"schema", "scene", "--markdown"});
    EXPECT_EQ(page.code, 0);
    EXPECT_THAT(page.out, StartsWith("# Scene reference\n"));
}

TEST(DoctorCommand, NamesProgramProcessorAndLibraries) {
    const Answer answer = invoke({"doctor"});
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_THAT(answer.out,
                AllOf(ContainsRegex("\ninstruction set +[a-z0-9]+ of scalar"),
                      ContainsRegex("\nthreads +[1-9]"),
                      ContainsRegex("\nVTK +9\\."),
                      ContainsRegex("\nHDF5 +1\\."),
                      ContainsRegex("\nEigen +3\\."),
                      ContainsRegex("\ndraws with +.*OpenGL [1-9]"),
                      ContainsRegex("\ncan write to +/")));
}

TEST(DoctorCommand, FolderThatCannotBeWrittenIsAnInputOutputError) {
    const TemporaryFolder folder;
    std::ostringstream out;
    std::ostringstream err;
    EXPECT_THAT(
        error_of([&] { doctor_command({.folder = folder / "absent"}, {.out = out, .err = err}); }),
        StartsWith("input/output: "));
}

class ExportCommand : public testing::Test {
protected:
    ExportCommand() {
        io::write_file(folder_ / "cup.json", cup_scene);
        const Answer answer = invoke({"run",
                                      (folder_ / "cup.json").string(),
                                      "-o",
                                      (folder_ / "run").string(),
                                      "--set",
                                      "/stages/0/duration=1e-4",
                                      "--set",
                                      "/stages/1/duration=1e-4"});
        EXPECT_EQ(answer.code, 0) << answer.err;
    }

    TemporaryFolder folder_;
};

TEST_F(ExportCommand, WritesBesideTheRunByDefault) {
    const Answer answer = invoke({"export", (folder_ / "run").string() + "/", "--format", "csv"});
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_THAT(answer.err, HasSubstr("files written to"));
    EXPECT_TRUE(io::file_exists(folder_ / "run-csv" / "realisation-2" / "particles_000001.csv"));
}

TEST_F(ExportCommand, WritesWhereItIsTold) {
    const std::string target = (folder_ / "frames").string();
    EXPECT_EQ(invoke({"export", (folder_ / "run").string(), "--format", "vtp", "-o", target}).code,
              0);
    EXPECT_TRUE(io::file_exists(folder_ / "frames" / "realisation-1" / "particles_000000.vtp"));
}

TEST_F(ExportCommand, FolderWithoutARunExitsWithTwo) {
    const Answer answer = invoke({"export", folder_.path().string(), "--format", "vtu"});
    EXPECT_EQ(answer.code, 2);
    EXPECT_THAT(answer.err, HasSubstr("next step: "));
}

}  // namespace
}  // namespace grainbench::cli
