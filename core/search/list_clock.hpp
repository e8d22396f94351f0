/// When the lists of one kind of contacts (between particles, or with one wall) are due. There are
/// two lists, each a part of the one before: candidates (a cell grid away) and contact objects
/// (within the detection tolerance, or somewhat farther where particles are fast). Of the objects
/// the look-ahead marks those that touch or may touch within a few steps: they count for the stable
/// step (share/doc/decisions/0004).
#pragma once

#include "core/search/travel_clock.hpp"

#include <algorithm>
#include <cstdint>
#include <string>

namespace grainbench {

/// How contact objects come and go; all lengths [m].
struct SearchSettings {
    double tolerance = 0.0625;  ///< [1] of a particle over its radius
    double widest = 0.0;        ///< [1] what lists may reach in its place where particles are fast
    double slack = 0.0;         ///< [m] travel that the candidate list allows beyond the tolerance
    double widest_slack = 0.0;  ///< [m] in its place where particles are fast
    std::int64_t interval = 0;  ///< cycles between renewals; 0 = displacement trigger
    bool brute_force = false;   ///< every pair is a contact object for ever (reference engine)
};

/// What is due, the most thorough first: what it names includes all that follow.
enum class Renewal { candidates, objects, look_ahead, none };

class ListClock {
public:
    ListClock() = default;

    explicit ListClock(const SearchSettings& settings) : settings_(settings) {}

    /// Adds the largest distance that any particle can have moved in a step, relative to the frame.
    /// \param fall what one moves in such a step that has fallen a little way [m]: look-aheads last
    /// as long as if the fastest did, for in a bed at rest all may soon move so
    void add_travel(double bound, double fall);

    /// Whether some particle may have travelled as far as the present look-ahead allows, or is
    /// another.
    bool look_ahead_is_due() const {
        return expired_ || (!settings_.brute_force && horizon_ > 0.0 && ahead_travel_ > horizon_);
    }

    /// \param looks_ahead whether a look-ahead follows in any case, or there never is one; between
    /// look-aheads lists are kept, if they can be, for one that is made anew needs another
    /// \param shift displacement of the frame so far
    /// \param exact whether positions may be compared (frames that do not turn)
    Renewal due(std::uint64_t cycle,
                bool looks_ahead,
                const ParticleState& particles,
                const Vec3& shift,
                bool exact,
                const Kernels& kernels);

    /// How far the list that is about to be made is to reach at the present speeds; candidates at
    /// least as far as the objects that are chosen from them.
    void choose_reach(Renewal what, double smallest_radius);

    /// Over the radius of a particle [1], and beyond it the slack [m].
    double candidate_reach() const { return candidate_reach_; }

    double candidate_slack() const { return candidate_slack_; }

    /// Over the radius of a particle [1].
    double object_reach() const { return object_reach_; }

    /// Call after each renewal.
    void renewed(Renewal what,
                 std::uint64_t cycle,
                 const ParticleState& particles,
                 const Vec3& shift);

    /// The particles are others: both lists are due.
    void expire(const ParticleState& particles);

    /// Starts a new look-ahead at the present speeds.
    void look_ahead(double smallest_radius);

    /// Travel of one particle that the present look-ahead allows [m]; 0 if there is none.
    double horizon() const { return horizon_; }

    /// Whether it lasts for a few steps only.
    bool horizon_is_short() const {
        return horizon_ <= steps_ahead * std::max(last_travel_, last_fall_);
    }

    const SearchSettings& settings() const { return settings_; }

    /// True once the first lists exist.
    bool is_started() const { return started_; }

    void save(Archive& archive, const std::string& name) const;
    void load(const Archive& archive, const std::string& name, const ParticleState& particles);

private:
    /// Steps at the present speed that a look-ahead should last. More steps mean fewer renewals and
    /// a smaller automatic step (share/doc/decisions/0004).
    static constexpr double steps_ahead = 2.5;

    /// Steps at the present speed that a list of contact objects should last, if it may reach so
    /// far. More steps mean fewer renewals and more objects to test.
    static constexpr double steps_of_list = 40.0;

    /// The same for candidates.
    static constexpr double steps_of_candidates = 100.0;

    double next_horizon(double smallest_radius) const;
    double object_travel(double smallest_radius) const;

    SearchSettings settings_;
    bool started_ = false;
    bool expired_ = false;
    std::uint64_t last_cycle_ = 0;
    TravelClock object_clock_{true};
    TravelClock candidate_clock_;
    double candidate_reach_ = 0.0;  ///< [1] over the radius, of the present lists
    double candidate_slack_ = 0.0;  ///< [m]
    double object_reach_ = 0.0;     ///< [1]
    double last_travel_ = 0.0;      ///< [m] bound of the last step
    double last_fall_ = 0.0;        ///< [m] of the last step
    double ahead_travel_ = 0.0;     ///< [m] since the look-ahead began
    double horizon_ = 0.0;
};

}  // namespace grainbench
