// Each case of the stability catalogue as a test of its own; GRAINBENCH_FULL asks for the long
// series.
#include "core/verify/registry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <iomanip>
#include <iterator>

namespace grainbench::verify {
namespace {

std::vector<Case> hard_cases() {
    std::vector<Case> cases;
    std::copy_if(
        all_cases().begin(), all_cases().end(), std::back_inserter(cases), [](const Case& one) {
            return one.name.rfind("stability/", 0) == 0;
        });
    return cases;
}

class Catalogue : public testing::TestWithParam<Case> {};

TEST_P(Catalogue, StaysWithinItsBounds) {
    for (const Check& check : checks_of(GetParam(), std::getenv("GRAINBENCH_FULL") != nullptr)) {
        EXPECT_TRUE(check.passes())
            << std::setprecision(12) << check.quantity << " [" << check.unit << "]: expected "
            << check.expected << ", got " << check.got << ", tolerance " << check.tolerance << " ("
            << check.reason << ")";
    }
}

INSTANTIATE_TEST_SUITE_P(
    Cases, Catalogue, testing::ValuesIn(hard_cases()), [](const testing::TestParamInfo<Case>& one) {
        std::string name = one.param.name.substr(one.param.name.find('/') + 1);
        std::replace_if(
            name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
        return name;
    });

}  // namespace

// Shown by GoogleTest in place of the bytes of a case.
void PrintTo(const Case& one, std::ostream* out) {
    *out << one.name << " (" << one.title << ")";
}

}  // namespace grainbench::verify
