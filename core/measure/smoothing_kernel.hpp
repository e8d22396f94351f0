/// What coarse graining smears a particle out with: a function of the distance that is smooth, ends
/// at its reach, and has the integral 1 over space.
///
/// Model    Gaussian: phi(r) = exp(-r^2 / (2 w^2)) / Z for r < 3 w, else 0                     (1)
///          Z = (2 pi)^(3/2) w^3 [erf(3 / sqrt 2) - 3 sqrt(2 / pi) exp(-9/2)]
///          Lucy: phi(r) = 105 / (16 pi c^3) (1 + 3 r/c) (1 - r/c)^3 for r < c, else 0         (2)
/// Source   (2) Lucy, Astron. J. 82 (1977) 1013-1024. Z is the integral of (1) over its ball.
/// Symbols  r distance from the particle; w width, c radius [m]; phi [1/m^3].
/// Limits   (1) steps at its end by 0.011 of its peak; (2) ends with two derivatives.
#pragma once

#include "core/scene/observables.hpp"

namespace grainbench {

class SmoothingKernel {
public:
    /// \param reach where it ends [m]
    SmoothingKernel(Kernel kernel, double reach);

    /// Where it ends [m].
    double reach() const { return reach_; }

    /// \param square of the distance [m^2]
    double at(double square) const;

    /// Integral along a straight line, in closed form [1/m^2].
    /// \param square of the distance of the line [m^2]
    /// \param from,to places on the line, counted from its point that is nearest [m]
    double along_line(double square, double from, double to) const;

private:
    double lucy_integral(double square, double u) const;

    bool is_gaussian_ = false;
    double reach_ = 1.0;  ///< [m]
    double scale_ = 1.0;  ///< [m] w or c
    double peak_ = 1.0;   ///< [1/m^3]
};

}  // namespace grainbench
