/// Force and torque of the particles on each wall, and how far it has been lifted.
///
/// Model    F = sum F_c,  M = sum x_c x F_c over the contacts of the wall
/// Symbols  F_c force of a contact on the wall [N], all of it; x_c closest point of the wall [m]
/// Limits   torques are about the origin; moments of rolling and twisting are left out of them.
#pragma once

#include "core/measure/measurement.hpp"
#include "core/scene.hpp"

namespace grainbench {

class WallForces : public Measurement {
public:
    explicit WallForces(const Scene& scene);

    void name_columns(std::vector<HistoryColumn>& columns) const override;
    void append_row(const MeasureView& view, std::vector<double>& row) const override;

private:
    std::vector<std::string> names_;
};

}  // namespace grainbench
