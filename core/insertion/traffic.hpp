/// Sinks and sources of a running scene: who goes, who comes, and how many did.
///
/// Model    a sink deletes what lies in it; a source owes floor(rate (t - start)) spheres at time
/// t,
///          at most `count`, none after `end`, and places them one by one at uniform random points
///          of its box where they overlap nothing.
/// Source   random sequential insertion as at the start (core/insertion/insert.hpp).
/// Limits   both act in the first cycle and every 64th after it. Newcomers keep a clearance of a
///          hundredth of their radius: their first contact is found before it acts. A source whose
///          box is full falls behind and catches up where it can.
#pragma once

#include "core/archive.hpp"
#include "core/state/particle_state.hpp"
#include "core/state/population.hpp"
#include "core/walls/wall_body.hpp"

#include <optional>
#include <string>
#include <vector>

namespace grainbench {

/// What went through one sink or source so far.
struct Passage {
    std::string name;
    std::int64_t count = 0;
    double mass = 0.0;  ///< [kg]
};

class Traffic {
public:
    /// \param seed of the realisation
    Traffic(const Scene& scene, std::uint64_t seed);

    /// Whether a scene has any.
    static bool is_in(const Scene& scene) {
        return !scene.particles.sinks.empty() || !scene.particles.sources.empty();
    }

    static bool is_due(std::uint64_t cycle) { return cycle % interval == 1; }

    /// What changes now; nothing if nobody comes or goes. Counts it as done.
    /// \param time [s]
    std::optional<PopulationChange> next_change(const ParticleState& particles,
                                                std::span<const WallBody> walls,
                                                double time);

    const std::vector<Passage>& went() const { return went_; }

    const std::vector<Passage>& came() const { return came_; }

    void save(Archive& archive) const;
    void load(const Archive& archive);

private:
    struct Feed {
        Source source;
        Index species = 0;
        double radius = 0.0;  ///< [m]
        double mass = 0.0;    ///< [kg]
        std::uint64_t seed = 0;
        std::uint64_t draws = 0;  ///< random numbers used
    };

    std::vector<Index> let_out(const ParticleState& particles);
    void let_in(const ParticleState& particles,
                std::span<const WallBody> walls,
                double time,
                PopulationChange& change);
    std::int64_t owed(const Feed& feed, std::int64_t placed, double time) const;

    static constexpr std::uint64_t interval = 64;  ///< cycles

    std::vector<Sink> sinks_;
    std::vector<Feed> feeds_;
    std::vector<double> radii_;  ///< [m] of all species
    std::vector<Passage> went_, came_;
};

}  // namespace grainbench
