#include "core/verify/case.hpp"

#include <array>
#include <cstdio>
#include <limits>
#include <utility>

namespace grainbench::verify {

Tolerance exact() {
    return {0.0, "the same bits"};
}

Tolerance round_off(double n, double scale) {
    return {n * std::numeric_limits<double>::epsilon() * std::abs(scale), "round-off"};
}

Tolerance relative(double fraction, double expected, std::string reason) {
    return {fraction * std::abs(expected), std::move(reason)};
}

std::string text_of(double number) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%g", number);
    return text.data();
}

void Checks::add(std::string quantity,
                 std::string unit,
                 double expected,
                 double got,
                 const Tolerance& tolerance) {
    checks_.push_back({.case_name = case_name_,
                       .quantity = std::move(quantity),
                       .unit = std::move(unit),
                       .expected = expected,
                       .got = got,
                       .tolerance = tolerance.absolute,
                       .reason = tolerance.reason});
}

std::vector<Check> checks_of(const Case& one, bool full) {
    Checks checks(one.name, full);
    one.run(checks);
    return checks.all();
}

}  // namespace grainbench::verify
