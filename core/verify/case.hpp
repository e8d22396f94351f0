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
    explicit Checks(std::string case_name, bool full = false)
        : case_name_(std::move(case_name)), full_(full) {}

    /// Whether to take the long series: minutes in place of seconds, for the same claims.
    bool is_full() const { return full_; }

    void add(std::string quantity,
             std::string unit,
             double expected,
             double got,
             const Tolerance& tolerance);

    /// A number that is to lie between -bound and bound.
    void add_bound(
        std::string quantity, std::string unit, double bound, double got, std::string reason) {
        add(std::move(quantity), std::move(unit), 0.0, got, {bound, std::move(reason)});
    }

    /// A claim that holds or does not.
    void add_claim(std::string claim, bool holds) {
        add(std::move(claim), "1", 1.0, holds ? 1.0 : 0.0, exact());
    }

    const std::vector<Check>& all() const { return checks_; }

private:
    std::string case_name_;
    bool full_ = false;
    std::vector<Check> checks_;
};

struct Case {
    std::string name;     ///< "topic/claim"
    std::string section;  ///< of the physics reference
    std::string title;
    std::function<void(Checks&)> run;
};

/// Runs a case. An error thrown by the engine passes through.
std::vector<Check> checks_of(const Case& one, bool full = false);

}  // namespace grainbench::verify
