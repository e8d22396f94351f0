/// Says when particles may have moved too far, relative to a moving frame (the bed's mean motion,
/// or a wall), for a list of neighbours to be trusted. A running bound from the largest speed costs
/// a few operations per step; only when it expires are the positions themselves compared.
#pragma once

#include "core/archive.hpp"
#include "core/state/particle_state.hpp"

#include <string>

namespace grainbench {

class TravelClock {
public:
    /// \param by_radius measure travel in units of the particle's radius over the smallest radius
    explicit TravelClock(bool by_radius = false) : by_radius_(by_radius) {}

    /// Forgets all travel; `shift` is the frame's displacement so far.
    void restart(const ParticleState& particles, const Vec3& shift);

    /// Adds the largest distance that any particle can have moved relative to the frame.
    void add(double bound) { travel_ += bound; }

    /// True if some particle has moved by more than `limit` [m]. Where `exact` is false (turning
    /// frames) the bound alone decides.
    bool expired(double limit,
                 const ParticleState& particles,
                 const Vec3& shift,
                 bool exact,
                 const Kernels& kernels);

    double travel() const { return travel_; }

    void save(Archive& archive, const std::string& name) const;
    void load(const Archive& archive, const std::string& name, const ParticleState& particles);

private:
    double measure(const ParticleState& particles, const Vec3& shift, const Kernels& kernels) const;

    bool by_radius_ = false;
    double travel_ = 0.0;
    Vec3 shift_{};
    Column<double> reference_;  ///< packets: positions at the restart
};

}  // namespace grainbench
