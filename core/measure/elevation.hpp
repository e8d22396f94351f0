/// Height of one group of particles over another, its running average, and the time at which the
/// upper group first rises above the lower one (entrainment).
///
/// Model    e = mean height of `upper` - mean height of `lower`; height along -g, or z without g
/// Source   physics reference 7.4; in metres here, where the example prints centimetres.
/// Limits   the average is over samples, which are equally spaced in cycles, not in time.
#pragma once

#include "core/archive.hpp"
#include "core/measure/measurement.hpp"

#include <optional>
#include <vector>

namespace grainbench {

class Elevation : public Measurement {
public:
    /// \param up unit vector
    Elevation(std::vector<Index> upper, std::vector<Index> lower, const Vec3& up);

    /// Averages from here on are over intervals of this length from time t on.
    void begin_interval(double t, double interval);

    /// Takes a sample and closes an averaging interval if one has ended.
    void sample(const ParticleState& particles, double t);

    /// Particles have other slots; what is gone no longer counts.
    void renumber(const PopulationChange& change);

    double compute(const ParticleState& particles) const;

    void name_columns(std::vector<HistoryColumn>& columns) const override;
    void append_row(const MeasureView& view, std::vector<double>& row) const override;

    /// Of the last sample [m].
    double last() const { return last_; }

    /// Of the last complete interval [m].
    std::optional<double> average() const { return average_; }

    /// [s]
    std::optional<double> entrainment_time() const { return entrainment_time_; }

    void save(Archive& archive) const;
    void load(const Archive& archive);

    /// Slots of both groups, which change where particles come and go.
    void save_members(Archive& archive) const;
    void load_members(const Archive& archive, Index particle_count);

private:
    std::vector<Index> upper_, lower_;
    Vec3 up_;
    double origin_ = 0.0;  ///< time at which the present intervals began
    double interval_ = 0.0;
    std::uint64_t complete_ = 0;  ///< intervals completed since origin_
    double sum_ = 0.0;
    std::uint64_t count_ = 0;
    double last_ = 0.0;
    std::optional<double> average_;
    std::optional<double> entrainment_time_;
};

}  // namespace grainbench
