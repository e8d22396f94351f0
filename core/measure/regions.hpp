/// Particles and mass in named parts of space.
///
/// Model    a particle belongs to a region if its centre does, its whole mass with it
/// Limits   faces belong to the region. Regions may overlap, and stand still. By group, a particle
///          counts for the first group that holds it.
#pragma once

#include "core/measure/measurement.hpp"
#include "core/scene.hpp"

namespace grainbench {

bool is_inside(const RegionShape& shape, const Vec3& point);

class Regions : public Measurement {
public:
    explicit Regions(const Scene& scene);

    void name_columns(std::vector<HistoryColumn>& columns) const override;
    void append_row(const MeasureView& view, std::vector<double>& row) const override;

private:
    const std::vector<std::string>& kinds_of(const RegionObservable& region) const;

    std::vector<RegionObservable> regions_;
    std::vector<std::string> species_, groups_;  ///< names
};

}  // namespace grainbench
