/// The same questions for curves: one sample of numbers at each of many points, with the points of
/// one realisation belonging together.
///
/// Model    same       at every point the (1 - 2 alpha) interval lies inside (-m, m)         (1)
///          different  at some point the simultaneous (1 - alpha) band lies outside [-m, m]  (2)
///          band       x_k +- q s_k, with q from Sidak's (1 - alpha)^(1/K) at each of K
///                     points, or, from `fewest_for_bootstrap` curves on, the quantile of
///                     max_k |t_k| over curves drawn again with replacement                  (3)
/// Source   (1) an intersection-union test needs no correction for many points: Berger,
///          Technometrics 24, 1982. (3) Sidak, J. Am. Stat. Assoc. 62, 1967; studentised bootstrap
///          of whole curves as in Degras, Statistica Sinica 21, 2011 (R package SCBmeanfd).
/// Limits   Sidak's band is wider than it had to be where neighbouring points are alike. With fewer
///          curves the bootstrap has too few different samples to draw.
#pragma once

#include "core/statistics/estimate.hpp"
#include "core/statistics/verdict.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace grainbench::statistics {

/// One vector per realisation, all of one length.
using Curves = std::vector<std::vector<double>>;

/// Values of all realisations at point k.
std::vector<double> values_at(const Curves& curves, std::size_t k);

/// Pointwise estimates of the mean curve.
std::vector<Estimate> mean_curve(const Curves& curves);

struct CurveDifference {
    std::vector<Estimate> at;   ///< of a over b at each point
    std::vector<double> reach;  ///< q s_k of the simultaneous band; infinite without errors
    std::size_t largest = 0;    ///< point with the largest absolute difference
    bool bootstrapped = false;  ///< where q comes from
};

inline constexpr std::size_t fewest_for_bootstrap = 12;

struct BootstrapOptions {
    std::size_t replicates = 1999;
    std::uint64_t seed = 1;
};

/// \param paired the curves of one index share a packing, and differences are taken between them
CurveDifference curve_difference(const Curves& a,
                                 const Curves& b,
                                 bool paired,
                                 const BootstrapOptions& options = {});

Verdict verdict_of(const CurveDifference& difference, double margin);

/// As for a number; `different` is judged at the point that shows it first.
std::optional<std::size_t> realisations_to_decide(const CurveDifference& difference,
                                                  std::size_t realisations,
                                                  double margin);

}  // namespace grainbench::statistics
