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

/// Travel of the smallest particle that the list of contact objects allows [m]: its tolerance, less
/// a few steps, so that a contact is an object before it can touch, and what the look-ahead needs,
/// so that it counts for the step before it can act. Where steps are that long (very soft
/// contacts), half the tolerance.
double ListClock::object_travel(double smallest_radius) const {
    const double whole = settings_.tolerance * smallest_radius;
    return std::max(whole - std::max(horizon_, steps_ahead * last_travel_), 0.5 * whole);
}

Renewal ListClock::due(std::uint64_t cycle,
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
    const bool objects_due =
        settings_.interval > 0
            ? cycle >= last_cycle_ + static_cast<std::uint64_t>(settings_.interval)
            : object_clock_.expired(
                  object_travel(particles.smallest_radius()), particles, shift, exact, kernels);
    if (objects_due) {
        return candidate_clock_.expired(settings_.slack, particles, shift, exact, kernels)
                   ? Renewal::candidates
                   : Renewal::objects;
    }
    return horizon_ > 0.0 && ahead_travel_ > horizon_ ? Renewal::look_ahead : Renewal::none;
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
    horizon_ =
        std::max(steps_ahead * std::max(last_travel_, last_fall_), least_horizon * smallest_radius);
    ahead_travel_ = 0.0;
}

void ListClock::save(Archive& archive, const std::string& name) const {
    object_clock_.save(archive, name + "/object_clock");
    candidate_clock_.save(archive, name + "/candidate_clock");
    archive.put(name + "/last_cycle", last_cycle_);
    archive.put(name + "/horizon",
                std::vector<double>{last_travel_, ahead_travel_, horizon_, last_fall_});
    archive.put(name + "/expired", std::uint64_t{expired_});
}

void ListClock::load(const Archive& archive,
                     const std::string& name,
                     const ParticleState& particles) {
    object_clock_.load(archive, name + "/object_clock", particles);
    candidate_clock_.load(archive, name + "/candidate_clock", particles);
    last_cycle_ = archive.count(name + "/last_cycle");
    const auto& horizon = archive.get<double>(name + "/horizon");
    Archive::require(horizon.size() == 3 || horizon.size() == 4, name + "/horizon");
    last_travel_ = horizon[0];
    ahead_travel_ = horizon[1];
    horizon_ = horizon[2];
    last_fall_ = horizon.size() > 3 ? horizon[3] : 0.0;  // older checkpoints have none
    expired_ = archive.count(name + "/expired") != 0;
    started_ = true;
}

}  // namespace grainbench
