/// How well two groups are mixed: Lacey's index over a grid of cubic cells.
///
/// Model    M = (s_0^2 - s^2) / (s_0^2 - s_r^2)                                                (1)
///          s^2 = sum_c n_c (p_c - p)^2 / N                                                    (2)
///          s_0^2 = p (1 - p),  s_r^2 = s_0^2 (C - 1) / (N - 1)                                (3)
///          I = s^2 / s_0^2                                                                    (4)
/// Source   Lacey, J. Appl. Chem. 4 (1954) 257-268 for (1); Danckwerts, Appl. Sci. Res. A 3 (1952)
///          279-296 for (4), the intensity of segregation.
/// Symbols  n_c particles of both groups in cell c, p_c share of the first group among them, p its
///          share of all N particles of both, C cells that hold a particle.
/// Derived  cells weigh by what they hold, so that one that is partly filled tells no more than it
///          knows. With these weights s_r^2 is the mean of (2) over all ways to deal N particles to
///          the cells at random, without replacement: mean 1 of M. For many cells it is Lacey's
///          s_0^2 / n with n = N / C.
/// Limits   shares go by number. M is 0 where every cell holds one group alone, near 1 in a random
///          mixture, and above 1 in an orderly one. One particle in each cell tells nothing: not a
///          number; so do groups of which one is empty.
#pragma once

#include "core/measure/measurement.hpp"
#include "core/scene.hpp"

namespace grainbench {

class Mixing : public Measurement {
public:
    explicit Mixing(const Scene& scene);

    void name_columns(std::vector<HistoryColumn>& columns) const override;
    void append_row(const MeasureView& view, std::vector<double>& row) const override;

private:
    std::int32_t first_ = 0, second_ = 0;  ///< 1 + index of the groups
    double cell_ = 0.0;                    ///< [m]
};

}  // namespace grainbench
