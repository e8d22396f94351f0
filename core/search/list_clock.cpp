#include "core/search/list_clock.hpp"

#include <algorithm>

namespace grainbench {

namespace {

/// Least horizon over the smallest radius: in a bed at rest speeds say nothing.
constexpr double least_horizon = 1e-3;

}  // namespace

void ListClock::add_travel(double bound, double fall) {
    object_clock_.add(bound);
    candidate_clock_.add(bound);
    ahead_travel_ += bound;
    last_travel_ = bound;
    last_fall_ = fall;
}

void ListClock::choose_reach(Renewal what, double smallest_radius) {
    const double wanted = steps_of_list * last_travel_ / smallest_radius;
    const double reach = std::max(settings_.tolerance, std::min(wanted, settings_.widest));
    if (what == Renewal::candidates) {
        candidate_reach_ = reach;
        candidate_slack_ = std::max(
            settings_.slack, std::min(steps_of_candidates * last_travel_, settings_.widest_slack));
    }
    object_reach_ = std::min(reach, candidate_reach_);
}

/// Travel of one particle that a look-ahead at the present speeds allows [m].
double ListClock::next_horizon(double smallest_radius) const {
    return std::max(steps_ahead * std::max(last_travel_, last_fall_),
                    least_horizon * smallest_radius);
}

/// Travel of the smallest particle that the list of contact objects allows where a look-ahead
/// begins [m]: its reach, less what the look-ahead needs, so that a contact is an object before it
/// counts for the step. Where steps are that long (very soft contacts), half the reach.
double ListClock::object_travel(double smallest_radius) const {
    const double whole = object_reach_ * smallest_radius;
    return std::max(whole - next_horizon(smallest_radius), 0.5 * whole);
}

Renewal ListClock::due(std::uint64_t cycle,
                       bool looks_ahead,
                       const ParticleState& particles,
                       const Vec3& shift,
                       bool exact,
                       const Kernels& kernels) {
    if (!started_ || expired_) {
        return Renewal::candidates;
    }
    if (settings_.brute_force) {
        return Renewal::none;
    }
    const double smallest = particles.smallest_radius();
    const double travel = looks_ahead ? object_travel(smallest) : object_reach_ * smallest;
    const bool objects_due =
        settings_.interval > 0
            ? cycle >= last_cycle_ + static_cast<std::uint64_t>(settings_.interval)
            : object_clock_.expired(travel, particles, shift, exact, kernels);
    if (objects_due) {
        return candidate_clock_.expired(candidate_slack_, particles, shift, exact, kernels)
                   ? Renewal::candidates
                   : Renewal::objects;
    }
    return look_ahead_is_due() ? Renewal::look_ahead : Renewal::none;
}

void ListClock::renewed(Renewal what,
                        std::uint64_t cycle,
                        const ParticleState& particles,
                        const Vec3& shift) {
    if (what == Renewal::candidates) {
        candidate_clock_.restart(particles, shift);
    }
    object_clock_.restart(particles, shift);
    last_cycle_ = cycle;
    started_ = true;
    expired_ = false;
}

void ListClock::expire(const ParticleState& particles) {
    expired_ = true;
    object_clock_.restart(particles, {});
    candidate_clock_.restart(particles, {});
}

void ListClock::look_ahead(double smallest_radius) {
    horizon_ = next_horizon(smallest_radius);
    ahead_travel_ = 0.0;
}

void ListClock::save(Archive& archive, const std::string& name) const {
    object_clock_.save(archive, name + "/object_clock");
    candidate_clock_.save(archive, name + "/candidate_clock");
    archive.put(name + "/last_cycle", last_cycle_);
    archive.put(name + "/horizon",
                std::vector<double>{last_travel_,
                                    ahead_travel_,
                                    horizon_,
                                    last_fall_,
                                    candidate_reach_,
                                    object_reach_,
                                    candidate_slack_});
    archive.put(name + "/expired", std::uint64_t{expired_});
}

void ListClock::load(const Archive& archive,
                     const std::string& name,
                     const ParticleState& particles) {
    object_clock_.load(archive, name + "/object_clock", particles);
    candidate_clock_.load(archive, name + "/candidate_clock", particles);
    last_cycle_ = archive.count(name + "/last_cycle");
    const auto& horizon = archive.get<double>(name + "/horizon");
    const std::size_t size = horizon.size();
    Archive::require(size == 3 || size == 4 || size == 7, name + "/horizon");
    last_travel_ = horizon[0];
    ahead_travel_ = horizon[1];
    horizon_ = horizon[2];
    // Older checkpoints have no fall, and lists that reach as far as the tolerance.
    last_fall_ = size > 3 ? horizon[3] : 0.0;
    candidate_reach_ = size > 4 ? horizon[4] : settings_.tolerance;
    object_reach_ = size > 4 ? horizon[5] : settings_.tolerance;
    candidate_slack_ = size > 4 ? horizon[6] : settings_.slack;
    expired_ = archive.count(name + "/expired") != 0;
    started_ = true;
}

}  // namespace grainbench
