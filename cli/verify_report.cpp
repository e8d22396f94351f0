#include "cli/verify_report.hpp"

#include "io/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace grainbench::cli {
namespace {

using verify::Check;

/// Cells of one check, in the order of the heads.
constexpr std::array<const char*, 8> heads{
    "case", "quantity", "unit", "expected", "got", "tolerance", "pass", "reason of the tolerance"};

using Cells = std::array<std::string, heads.size()>;

Cells cells_of(const Check& check) {
    return {check.case_name,
            check.quantity,
            check.unit,
            fmt::format("{:.9g}", check.expected),
            fmt::format("{:.9g}", check.got),
            fmt::format("{:.2g}", check.tolerance),
            check.passes() ? "yes" : "NO",
            check.reason};
}

std::string sum_up(const std::vector<CaseResult>& results) {
    std::size_t checks = 0;
    std::size_t failed = 0;
    for (const CaseResult& result : results) {
        checks += result.checks.size();
        failed += static_cast<std::size_t>(
            std::count_if(result.checks.begin(), result.checks.end(), [](const Check& check) {
                return !check.passes();
            }));
    }
    return fmt::format("{} checks in {} cases: {}",
                       checks,
                       results.size(),
                       failed == 0 ? "all pass" : fmt::format("{} fail", failed));
}

std::string json_string(const std::string& text) {
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') {
            quoted += '\\';
            quoted += c;
        } else if (static_cast<unsigned char>(c) < 0x20) {
            quoted += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
        } else {
            quoted += c;
        }
    }
    return quoted + '"';
}

/// JSON has no word for what is not finite.
std::string json_number(double number) {
    return std::isfinite(number) ? io::to_text(number) : "null";
}

std::string json_of(const Check& check) {
    return fmt::format(
        "{{\"quantity\": {}, \"unit\": {}, \"expected\": {}, \"got\": {}, \"tolerance\": {}, "
        "\"reason\": {}, \"pass\": {}}}",
        json_string(check.quantity),
        json_string(check.unit),
        json_number(check.expected),
        json_number(check.got),
        json_number(check.tolerance),
        json_string(check.reason),
        check.passes());
}

/// Text that may hold the bar which parts the columns.
std::string markdown_cell(const std::string& text) {
    std::string cell;
    for (const char c : text) {
        cell += c == '|' ? "\\|" : c == '\n' ? " " : std::string(1, c);
    }
    return cell;
}

std::string xml_text(const std::string& text) {
    std::string safe;
    for (const char c : text) {
        safe += c == '&'                               ? "&amp;"
                : c == '<'                             ? "&lt;"
                : c == '>'                             ? "&gt;"
                : c == '"'                             ? "&quot;"
                : static_cast<unsigned char>(c) < 0x20 ? " "
                                                       : std::string(1, c);
    }
    return safe;
}

}  // namespace

bool CaseResult::passes() const {
    return std::all_of(
        checks.begin(), checks.end(), [](const Check& check) { return check.passes(); });
}

std::string verify_text(const std::vector<CaseResult>& results) {
    std::vector<Cells> rows{Cells{}};
    std::copy(heads.begin(), heads.end(), rows.front().begin());
    for (const CaseResult& result : results) {
        for (const Check& check : result.checks) {
            rows.push_back(cells_of(check));
        }
    }
    std::array<std::size_t, heads.size()> widths{};
    for (const Cells& row : rows) {
        for (std::size_t c = 0; c < row.size(); ++c) {
            widths[c] = std::max(widths[c], row[c].size());
        }
    }
    std::string text;
    for (const Cells& row : rows) {
        for (std::size_t c = 0; c + 1 < row.size(); ++c) {
            const bool is_number = c >= 3 && c <= 5;
            text += is_number ? fmt::format("{:>{}}  ", row[c], widths[c])
                              : fmt::format("{:<{}}  ", row[c], widths[c]);
        }
        text += row.back() + "\n";
    }
    return text + sum_up(results) + "\n";
}

std::string verify_markdown(const std::vector<CaseResult>& results) {
    std::string text = "# Verification\n\n" + sum_up(results) + "\n";
    for (const CaseResult& result : results) {
        text += fmt::format("\n## {}: {}\n\nReference section {}; {}.\n\n",
                            result.one.name,
                            result.one.title,
                            result.one.section,
                            result.passes() ? "passes" : "FAILS");
        std::string rule = "|";
        text += "|";
        for (std::size_t c = 1; c < heads.size(); ++c) {
            text += fmt::format(" {} |", heads[c]);
            rule += c >= 3 && c <= 5 ? " ---: |" : " --- |";
        }
        text += "\n" + rule + "\n";
        for (const Check& check : result.checks) {
            const Cells cells = cells_of(check);
            text += "|";
            for (std::size_t c = 1; c < cells.size(); ++c) {
                text += fmt::format(" {} |", markdown_cell(cells[c]));
            }
            text += "\n";
        }
    }
    return text;
}

std::string verify_junit(const std::vector<CaseResult>& results) {
    std::string cases;
    std::size_t failed = 0;
    for (const CaseResult& result : results) {
        std::string failures;
        for (const Check& check : result.checks) {
            if (!check.passes()) {
                failures += fmt::format("      {}: expected {:.9g} +- {:.2g} {}, got {:.9g} ({})\n",
                                        check.quantity,
                                        check.expected,
                                        check.tolerance,
                                        check.unit,
                                        check.got,
                                        check.reason);
            }
        }
        failed += failures.empty() ? 0 : 1;
        cases += fmt::format("    <testcase classname=\"verify\" name=\"{}\"",
                             xml_text(result.one.name));
        cases += failures.empty() ? "/>\n"
                                  : fmt::format(
                                        ">\n      <failure>\n{}      </failure>\n"
                                        "    </testcase>\n",
                                        xml_text(failures));
    }
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n"
        "  <testsuite name=\"grainbench verify\" tests=\"{}\" failures=\"{}\">\n"
        "{}  </testsuite>\n</testsuites>\n",
        results.size(),
        failed,
        cases);
}

std::string verify_json(const std::vector<CaseResult>& results) {
    const bool pass = std::all_of(
        results.begin(), results.end(), [](const CaseResult& result) { return result.passes(); });
    std::string text = fmt::format(
        "{{\n  \"format\": \"grainbench-verification/1\",\n  \"pass\": {},\n  \"cases\": [", pass);
    const char* between = "";
    for (const CaseResult& result : results) {
        text += fmt::format(
            "{}\n    {{\n      \"name\": {},\n      \"section\": {},\n      "
            "\"title\": {},\n      \"pass\": {},\n      \"checks\": [",
            between,
            json_string(result.one.name),
            json_string(result.one.section),
            json_string(result.one.title),
            result.passes());
        const char* comma = "";
        for (const Check& check : result.checks) {
            text += fmt::format("{}\n        {}", comma, json_of(check));
            comma = ",";
        }
        text += "\n      ]\n    }";
        between = ",";
    }
    return text + "\n  ]\n}\n";
}

}  // namespace grainbench::cli
