/// Student's t distribution: where the intervals of small samples come from.
///
/// Model    F(t) = 1 - I_x(nu/2, 1/2) / 2 for t >= 0, x = nu / (nu + t^2)                    (1)
///          I_x by its continued fraction                                                    (2)
/// Source   (1) NIST Digital Library of Mathematical Functions 8.17 with the definition of the
///          distribution; (2) the same, 8.17.22, evaluated by the modified Lentz algorithm.
/// Symbols  nu degrees of freedom [1], any positive number; I_x regularised incomplete beta
/// Limits   error of a probability below 1e-11 for nu from 0.5 to 1e4 and below 1e-9 at 1e6, from
/// the
///          logarithms of large gamma functions
#pragma once

namespace grainbench::statistics {

/// Probability of a value below t.
double student_cdf(double t, double degrees_of_freedom);

/// The t with that probability below it; p in (0, 1).
double student_quantile(double p, double degrees_of_freedom);

}  // namespace grainbench::statistics
