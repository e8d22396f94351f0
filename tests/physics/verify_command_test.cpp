#include "cli/verify_command.hpp"

#include "core/error.hpp"
#include "core/verify/registry.hpp"

#include "io/atomic_file.hpp"

#include "cli/exit_codes.hpp"
#include "cli/verify_report.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sstream>

namespace grainbench::cli {
namespace {

struct Answer {
    int code = 0;
    std::string out;
};

Answer verify_with(const VerifyArguments& arguments) {
    std::ostringstream out;
    std::ostringstream err;
    const int code = verify_command(arguments, {.out = out, .err = err});
    return {code, out.str()};
}

CaseResult result_with(double got) {
    return {.one = {.name = "topic/claim", .section = "1.2", .title = "a title", .run = {}},
            .checks = {{.case_name = "topic/claim",
                        .quantity = "a \"quoted\" | b",
                        .unit = "m",
                        .expected = 1.0,
                        .got = got,
                        .tolerance = 0.25,
                        .reason = "for the test"}}};
}

TEST(VerifyCommand, PrintsARowForEachCheckOfTheCasesChosen) {
    const Answer answer = verify_with({.filter = "^timestep/growth$"});
    EXPECT_EQ(answer.code, exit_ok);
    EXPECT_NE(answer.out.find("largest growth from cycle to cycle"), std::string::npos);
    EXPECT_NE(answer.out.find("3 checks in 1 cases: all pass"), std::string::npos);
}

TEST(VerifyCommand, WritesTheSameJsonThatItPrints) {
    const std::filesystem::path folder =
        std::filesystem::path(testing::TempDir()) / "verify-command-json";
    const Answer answer =
        verify_with({.filter = "timestep/(growth|bounds)", .json = true, .folder = folder});
    EXPECT_EQ(answer.out, io::read_file(folder / "verify.json"));
    const auto json = nlohmann::json::parse(answer.out);
    EXPECT_EQ(json.at("pass"), true);
    ASSERT_EQ(json.at("cases").size(), 2U);
    EXPECT_EQ(json.at("cases")[0].at("name"), "timestep/growth");
    EXPECT_EQ(json.at("cases")[0].at("checks")[0].at("expected"), 1.05);
    EXPECT_NE(io::read_file(folder / "verify.md").find("## timestep/bounds"), std::string::npos);
    std::filesystem::remove_all(folder);
}

TEST(VerifyCommand, RefusesFiltersThatChooseNothingOrAreBroken) {
    for (const char* filter : {"no such case", "impact/("}) {
        try {
            verify_with({.filter = filter});
            FAIL() << filter;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::bad_input) << filter;
            EXPECT_EQ(error.diagnosis().where, "--filter") << filter;
        }
    }
}

TEST(VerifyReport, SaysWhichCheckFails) {
    const std::vector<CaseResult> results{result_with(1.5), result_with(1.125)};
    EXPECT_FALSE(results.front().passes());
    EXPECT_TRUE(results.back().passes());
    const std::string text = verify_text(results);
    EXPECT_NE(text.find("2 checks in 2 cases: 1 fail"), std::string::npos) << text;
    EXPECT_NE(text.find("NO"), std::string::npos) << text;
    EXPECT_NE(verify_markdown(results).find("FAILS"), std::string::npos);
    EXPECT_NE(verify_markdown(results).find("a \"quoted\" \\| b"), std::string::npos);
}

TEST(VerifyReport, WritesJUnitWithItsFailures) {
    const std::string xml = verify_junit({result_with(1.5), result_with(1.125)});
    EXPECT_NE(xml.find("tests=\"2\" failures=\"1\""), std::string::npos) << xml;
    EXPECT_NE(xml.find("a &quot;quoted&quot; | b"), std::string::npos) << xml;
    EXPECT_NE(xml.find("name=\"topic/claim\"/>"), std::string::npos) << xml;
}

TEST(VerifyReport, WritesJsonWhateverTheTextAndTheNumbers) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto json = nlohmann::json::parse(verify_json({result_with(nan)}));
    const auto& check = json.at("cases")[0].at("checks")[0];
    EXPECT_EQ(check.at("quantity"), "a \"quoted\" | b");
    EXPECT_TRUE(check.at("got").is_null());
    EXPECT_EQ(check.at("pass"), false);
    EXPECT_EQ(json.at("pass"), false);
}

}  // namespace
}  // namespace grainbench::cli
