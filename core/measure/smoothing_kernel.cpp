#include "core/measure/smoothing_kernel.hpp"

#include <algorithm>
#include <cmath>

namespace grainbench {

namespace {

/// Where the Gaussian is cut, over its width.
constexpr double cut = 3.0;

}  // namespace

SmoothingKernel::SmoothingKernel(Kernel kernel, double reach)
    : is_gaussian_(kernel == Kernel::gaussian), reach_(reach) {
    if (is_gaussian_) {
        scale_ = reach / cut;
        const double within =
            std::erf(cut / std::sqrt(2.0)) - cut * std::sqrt(2.0 / pi) * std::exp(-0.5 * cut * cut);
        peak_ = 1.0 / (std::pow(2.0 * pi, 1.5) * scale_ * scale_ * scale_ * within);
    } else {
        scale_ = reach;
        peak_ = 105.0 / (16.0 * pi * scale_ * scale_ * scale_);
    }
}

double SmoothingKernel::at(double square) const {
    if (square >= reach_ * reach_) {
        return 0.0;
    }
    if (is_gaussian_) {
        return peak_ * std::exp(-0.5 * square / (scale_ * scale_));  // (1)
    }
    const double a = std::sqrt(square) / scale_;
    const double b = 1.0 - a;
    return peak_ * (1.0 + 3.0 * a) * (b * b * b);  // (2)
}

double SmoothingKernel::along_line(double square, double from, double to) const {
    const double half_square = reach_ * reach_ - square;
    if (half_square <= 0.0) {
        return 0.0;
    }
    const double half = std::sqrt(half_square);
    from = std::max(from, -half);
    to = std::min(to, half);
    if (from >= to) {
        return 0.0;
    }
    if (is_gaussian_) {
        const double unit = std::sqrt(2.0) * scale_;
        return peak_ * std::exp(-square / (unit * unit)) * 0.5 * std::sqrt(pi) * unit *
               (std::erf(to / unit) - std::erf(from / unit));
    }
    return lucy_integral(square, to) - lucy_integral(square, from);
}

/// Of (2) written out, 1 - 6 a^2 + 8 a^3 - 3 a^4 with a^2 = p^2 + x^2, from x = 0 to x = u / c.
double SmoothingKernel::lucy_integral(double square, double u) const {
    const double p = square / (scale_ * scale_);  // the square of p
    const double x = u / scale_;
    const double a = std::sqrt(p + x * x);
    const double second = x * (p + x * x / 3.0);
    const double fourth = x * (p * p + x * x * (2.0 * p / 3.0 + x * x / 5.0));
    const double logarithm = p > 0.0 ? p * p * std::asinh(x / std::sqrt(p)) : 0.0;
    const double third = x * a * (2.0 * a * a + 3.0 * p) / 8.0 + 3.0 / 8.0 * logarithm;
    return peak_ * scale_ * (x - 6.0 * second + 8.0 * third - 3.0 * fourth);
}

}  // namespace grainbench
