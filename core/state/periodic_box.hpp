/// Periodic directions of a running scene: where particles are wrapped to, and where their images
/// stand.
///
/// Model    a particle that comes within `margin` of an end of a periodic interval of length L has
/// an
///          image beyond the other end, L away; near several ends at once, images for all of them.
/// Source   ghost particles, as molecular dynamics has them; share/doc/decisions/0009.
/// Limits   an interval must be longer than twice the reach of the candidate list, so that of two
///          particles only one pair of images can be near. Walls are not repeated.
#pragma once

#include "core/scene/periodic.hpp"
#include "core/types.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace grainbench {

/// A row that stands for a particle beyond a periodic boundary.
struct Image {
    Index owner = 0;
    Vec3 shift{};  ///< [m] of the image from its owner
};

class PeriodicBox {
public:
    PeriodicBox() = default;

    explicit PeriodicBox(const Periodic& periodic)
        : intervals_{periodic.x, periodic.y, periodic.z} {}

    bool is_periodic() const { return intervals_[0] || intervals_[1] || intervals_[2]; }

    /// Length of the interval along an axis [m]; 0 where there is none.
    double period(std::size_t axis) const {
        return intervals_[axis] ? intervals_[axis]->high - intervals_[axis]->low : 0.0;
    }

    /// Whole periods by which a point lies beyond the lower ends; 0 inside.
    std::array<double, 3> periods_from(const Vec3& point) const {
        const double x[3] = {point.x, point.y, point.z};
        std::array<double, 3> periods{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (intervals_[axis]) {
                periods[axis] = std::floor((x[axis] - intervals_[axis]->low) / period(axis));
            }
        }
        return periods;
    }

    /// The same point in the box.
    Vec3 wrapped(const Vec3& point) const {
        return is_periodic() ? point - way(periods_from(point)) : point;
    }

    /// The shortest of the ways from one point to another or its repetitions.
    Vec3 shortest(const Vec3& way_between) const {
        std::array<double, 3> periods{};
        const double x[3] = {way_between.x, way_between.y, way_between.z};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            periods[axis] = intervals_[axis] ? std::round(x[axis] / period(axis)) : 0.0;
        }
        return is_periodic() ? way_between - way(periods) : way_between;
    }

    /// Way of so many periods [m].
    Vec3 way(const std::array<double, 3>& periods) const {
        return {periods[0] * period(0), periods[1] * period(1), periods[2] * period(2)};
    }

    /// Appends the shifts of all images of a centre, which lies in the box [m].
    void collect_shifts(const Vec3& centre, double margin, std::vector<Vec3>& shifts) const {
        const double x[3] = {centre.x, centre.y, centre.z};
        std::array<std::array<double, 3>, 3> steps{};
        std::array<std::size_t, 3> count{1, 1, 1};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (!intervals_[axis]) {
                continue;
            }
            if (x[axis] < intervals_[axis]->low + margin) {
                steps[axis][count[axis]++] = period(axis);
            }
            if (x[axis] > intervals_[axis]->high - margin) {
                steps[axis][count[axis]++] = -period(axis);
            }
        }
        for (std::size_t k = 1; k < count[0] * count[1] * count[2]; ++k) {
            shifts.push_back({steps[0][k % count[0]],
                              steps[1][k / count[0] % count[1]],
                              steps[2][k / count[0] / count[1]]});
        }
    }

private:
    std::array<std::optional<Interval>, 3> intervals_;
};

}  // namespace grainbench
