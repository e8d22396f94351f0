/// Errors that a user can act on. Each says what, where, the likely cause and one next step, and
/// carries the class that decides the exit code (cli/exit_codes.hpp).
#pragma once

#include <stdexcept>
#include <string>

namespace grainbench {

enum class ErrorKind {
    bad_input,    ///< the scene, a file's content or an argument is wrong
    unstable,     ///< a run-time guard stopped the simulation
    input_output  ///< a file cannot be read or written
};

/// Parts of a message. `where` is a JSON pointer ("/walls/2/motion"), a file, or both.
struct Diagnosis {
    std::string what;
    std::string where;
    std::string likely_cause;
    std::string next_step;
};

class Error : public std::runtime_error {
public:
    Error(ErrorKind kind, Diagnosis diagnosis)
        : std::runtime_error(compose(diagnosis)), kind_(kind), diagnosis_(std::move(diagnosis)) {}

    ErrorKind kind() const { return kind_; }

    const Diagnosis& diagnosis() const { return diagnosis_; }

private:
    static std::string compose(const Diagnosis& d) {
        std::string text = d.what;
        if (!d.where.empty()) {
            text += "\n  where: " + d.where;
        }
        if (!d.likely_cause.empty()) {
            text += "\n  likely cause: " + d.likely_cause;
        }
        if (!d.next_step.empty()) {
            text += "\n  next step: " + d.next_step;
        }
        return text;
    }

    ErrorKind kind_;
    Diagnosis diagnosis_;
};

[[noreturn]] inline void throw_bad_input(Diagnosis diagnosis) {
    throw Error(ErrorKind::bad_input, std::move(diagnosis));
}

[[noreturn]] inline void throw_input_output(Diagnosis diagnosis) {
    throw Error(ErrorKind::input_output, std::move(diagnosis));
}

}  // namespace grainbench
