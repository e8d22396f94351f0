/// What the rows of a history are made of: one measurement for each observable that a scene asks
/// for. It looks at the state when a row is due and at no other time, and keeps nothing of it. The
/// next one is a file of its own and a line in measurements.cpp.
#pragma once

#include "core/body/body_forces.hpp"
#include "core/contact/pair_contacts.hpp"
#include "core/contact/wall_contacts.hpp"
#include "core/frame.hpp"

#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace grainbench {

class EnergyLedger;

/// What there is to measure; all at one full step.
struct MeasureView {
    const ParticleState& particles;
    const PairContacts& pairs;
    std::span<const WallBody> walls;
    std::span<const WallContacts> wall_contacts;
    std::span<const std::int32_t> groups;  ///< by slot: 1 + index of its first group, 0 if none
    BodyForces body;
    double timestep = 0.0;                 ///< [s] of the last cycle
    const EnergyLedger* ledger = nullptr;  ///< null where the scene asks for none

    /// Centre, within the periodic box [m].
    Vec3 position(Index slot) const { return particles.box().wrapped(particles.position(slot)); }

    /// Velocity at the full step [m/s].
    Vec3 full_velocity(Index slot) const {
        return particles.velocity(slot) + 0.5 * timestep * body.acceleration(particles, slot);
    }
};

class Measurement {
public:
    Measurement() = default;
    virtual ~Measurement() = default;
    Measurement(const Measurement&) = delete;
    Measurement& operator=(const Measurement&) = delete;

    /// Adds the columns that append_row() fills.
    virtual void name_columns(std::vector<HistoryColumn>& columns) const = 0;

    virtual void append_row(const MeasureView& view, std::vector<double>& row) const = 0;
};

/// a / b; where b is 0 there is nothing to measure, and that is no number. (Dividing would say so
/// as well, but is trapped where traps are on.)
inline double ratio(double a, double b) {
    return b != 0.0 ? a / b : std::numeric_limits<double>::quiet_NaN();
}

/// Of the observables of a scene, in the order of their columns. The elevation, which samples as
/// the run goes on, is not among them. \param up unit vector that heights are taken along
std::vector<std::unique_ptr<Measurement>> build_measurements(const Scene& scene, const Vec3& up);

}  // namespace grainbench
