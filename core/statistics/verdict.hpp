/// Is a difference too small to matter? Three answers, each with a bounded chance of being wrong.
///
/// Model    same       the (1 - 2 alpha) interval lies inside (-m, m): two one-sided tests at
///                     level alpha                                                           (1)
///          different  the (1 - alpha) interval lies outside [-m, m]: one-sided tests at level
///                     alpha / 2 on either side                                              (2)
///          undecided  otherwise
/// Source   (1) Schuirmann, J. Pharmacokin. Biopharm. 15, 1987. (1) with (2): Goeman, Solari and
///          Stijnen, "Three-sided hypothesis testing", Statistics in Medicine 29, 2010; the tests
///          beyond a margin are also known as minimal-effects tests.
/// Symbols  m margin, the largest difference that does not matter, in the unit of the value
/// Limits   where |difference| >= m, `same` is said with a chance of at most alpha; where
///          |difference| <= m, `different` is. The number of realisations follows Chow, Shao and
///          Wang, "Sample Size Calculations in Clinical Research", 2003, with t in place of z: the
///          number at which the present difference and spread would decide in four of five
///          repetitions.
#pragma once

#include "core/statistics/estimate.hpp"

#include <cstddef>
#include <optional>
#include <string_view>

namespace grainbench::statistics {

enum class Verdict { same, different, undecided };

std::string_view name_of(Verdict verdict);

inline constexpr double verdict_alpha = 0.05;

/// Undecided where the estimate has no standard error.
Verdict verdict_of(const Estimate& difference, double margin);

/// Realisations of each of the two samples that would decide; none if more than
/// `most_realisations`. \param spread sqrt(s_a^2 + s_b^2): the standard error is spread / sqrt(n)
/// \param comparisons that a `different` must hold against (points of a curve; else 1)
std::optional<std::size_t> realisations_to_decide(double difference,
                                                  double spread,
                                                  double margin,
                                                  std::size_t comparisons = 1);

inline constexpr std::size_t most_realisations = 10'000;

}  // namespace grainbench::statistics
