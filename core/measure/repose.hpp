/// Angle of a heap about a vertical line, or of a free surface along a direction.
///
/// Model    h = a + b s, least squares over the surface particles; angle = atan(b), of a heap
///          atan(-b)                                                                           (1)
/// Source   none: the plan is cut into square columns, and the particle of each column whose centre
///          is highest is on the surface.
/// Symbols  h height of a centre [m]; s its distance from the line, or its place along the
///          direction [m]; both those of the particle, so that the width of the columns does not
///          bend a straight surface.
/// Limits   up is against the gravity of the scene, or z without; stages that tilt gravity tilt the
///          surface, not up. Grains that fly above the bed, or lie apart from the heap, count: set
///          the range so that none do. The residual, the root of the mean square of what (1)
///          leaves [m], tells: a plain slope of grains leaves a fraction of a diameter. Fewer than
///          three columns: not a number. Distances do not reach across periodic boundaries.
#pragma once

#include "core/measure/measurement.hpp"
#include "core/scene.hpp"

namespace grainbench {

class Repose : public Measurement {
public:
    /// \param up unit vector
    Repose(const ReposeObservable& wanted, const Vec3& up);

    void name_columns(std::vector<HistoryColumn>& columns) const override;
    void append_row(const MeasureView& view, std::vector<double>& row) const override;

private:
    struct Place {
        double along;   ///< [m] s, and the first coordinate of the plan for a slope
        double height;  ///< [m]
        double x, y;    ///< [m] in the plan
    };

    Place place_of(const Vec3& position) const;

    ReposeObservable wanted_;
    Vec3 up_, x_, y_;  ///< x_ and y_ span the plan
    double from_ = 0.0, to_ = 0.0;
};

}  // namespace grainbench
