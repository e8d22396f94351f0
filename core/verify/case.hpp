/// What a verification case is: a scene with a known answer, and the checks it yields. The command
/// `grainbench verify` prints them as a table, the tests run each case on its own.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace grainbench::verify {

/// How far a number may be off, and why that far.
struct Tolerance {
    double absolute = 0.0;  ///< in the unit of the check
    std::string reason;
};

/// The same bits.
Tolerance exact();

/// n roundings of numbers of about this size.
Tolerance round_off(double n, double scale);

/// A fraction of the expected value.
Tolerance relative(double fraction, double expected, std::string reason);

/// Six digits at most, for the names of quantities.
std::string text_of(double number);

struct Check {
    std::string case_name;
    std::string quantity;
    std::string unit;  ///< "1" for a pure number
    double expected = 0.0;
    double got = 0.0;
    double tolerance = 0.0;  ///< absolute
    std::string reason;

    /// False too where a number is not finite.
    bool passes() const { return std::abs(got - expected) <= tolerance; }
};

/// Collects the checks of one case.
class Checks {
public:
    explicit Checks(std::string case_name) : case_name_(std::move(case_name)) {}

    void add(std::string quantity,
             std::string unit,
             double expected,
             double got,
             const Tolerance& tolerance);

    const std::vector<Check>& all() const { return checks_; }

private:
    std::string case_name_;
    std::vector<Check> checks_;
};

struct Case {
    std::string name;     ///< "topic/claim"
    std::string section;  ///< of the physics reference
    std::string title;
    std::function<void(Checks&)> run;
};

/// Runs a case. An error thrown by the engine passes through.
std::vector<Check> checks_of(const Case& one);

}  // namespace grainbench::verify
