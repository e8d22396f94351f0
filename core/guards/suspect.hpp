/// Words for trouble: who, where, when, with whom, and what most likely led there. Shared by the
/// guards and by the engine, which stops by itself where it cannot go on.
#pragma once

#include "core/error.hpp"
#include "core/types.hpp"

#include <optional>
#include <string>

namespace grainbench {

class Engine;

/// "%.6g"
std::string text_of(double number);

/// "particle 12 (small)"
std::string name_of(const Engine& engine, Index slot);

/// Place of the particle, if there is one, and whom it touches; cycle, time and step.
std::string circumstances(const Engine& engine, std::optional<Index> slot);

/// The cause of a state that no scheme could have made at a stable step: a step above the limit, if
/// it is one, else the words given.
Diagnosis blame_step_or(const Engine& engine, Diagnosis otherwise);

/// A particle whose velocity or position is not finite, or so large that no list could hold it.
[[noreturn]] void throw_runaway(const Engine& engine);

}  // namespace grainbench
