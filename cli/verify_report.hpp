/// What `grainbench verify` prints and writes: one row for each check, three ways.
#pragma once

#include "core/verify/case.hpp"

#include <string>
#include <vector>

namespace grainbench::cli {

struct CaseResult {
    verify::Case one;
    std::vector<verify::Check> checks;

    bool passes() const;
};

/// Aligned columns and a line that sums up.
std::string verify_text(const std::vector<CaseResult>& results);

std::string verify_markdown(const std::vector<CaseResult>& results);

/// JUnit's XML, a test case for each case, for machines that show failed tests.
std::string verify_junit(const std::vector<CaseResult>& results);

std::string verify_json(const std::vector<CaseResult>& results);

}  // namespace grainbench::cli
