#include "core/verify/registry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <iomanip>
#include <iterator>
#include <limits>
#include <set>

namespace grainbench::verify {
namespace {

/// All but the stability catalogue, which tests/stability runs.
std::vector<Case> plain_cases() {
    std::vector<Case> cases;
    std::copy_if(
        all_cases().begin(), all_cases().end(), std::back_inserter(cases), [](const Case& one) {
            return one.name.rfind("stability/", 0) != 0;
        });
    return cases;
}

class Verify : public testing::TestWithParam<Case> {};

TEST_P(Verify, AgreesWithTheReference) {
    const std::vector<Check> checks = checks_of(GetParam());
    EXPECT_FALSE(checks.empty());
    for (const Check& check : checks) {
        EXPECT_TRUE(check.passes())
            << std::setprecision(12) << check.quantity << " [" << check.unit << "]: expected "
            << check.expected << ", got " << check.got << ", tolerance " << check.tolerance << " ("
            << check.reason << ")";
    }
}

INSTANTIATE_TEST_SUITE_P(
    Cases, Verify, testing::ValuesIn(plain_cases()), [](const testing::TestParamInfo<Case>& one) {
        std::string name = one.param.name;
        std::replace_if(
            name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
        return name;
    });

TEST(VerifyRegistry, NamesEachCaseOnce) {
    std::set<std::string> names;
    for (const Case& one : all_cases()) {
        EXPECT_TRUE(names.insert(one.name).second) << one.name;
    }
}

TEST(VerifyCheck, FailsBeyondItsToleranceAndOnWhatIsNotANumber) {
    Check check{.case_name = "",
                .quantity = "",
                .unit = "1",
                .expected = 1.0,
                .got = 1.5,
                .tolerance = 0.5,
                .reason = ""};
    EXPECT_TRUE(check.passes());
    check.got = 1.75;
    EXPECT_FALSE(check.passes());
    check.got = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(check.passes());
}

}  // namespace

// Shown by GoogleTest in place of the bytes of a case.
void PrintTo(const Case& one, std::ostream* out) {
    *out << one.name << " (" << one.title << ")";
}

}  // namespace grainbench::verify
