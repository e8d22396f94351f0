/// Contacts between particles, in three lists, each a part of the one before and each renewed when
/// particles may have travelled far enough to matter: candidates (a cell grid away), contact
/// objects (within the detection tolerance; they hold the history) and those that may touch soon
/// (within the travel of a few steps; they count for the stable step). Touching contacts are looked
/// for in the last only. Lists are in lexicographic order of (i, j), so that history is carried
/// over in one sweep and forces are summed in one fixed order.
#pragma once

#include "core/contact/contact_table.hpp"
#include "core/search/candidates.hpp"
#include "core/search/travel_clock.hpp"

#include <algorithm>

namespace grainbench {

/// How contact objects come and go; all lengths [m].
struct SearchSettings {
    double tolerance = 0.0625;  ///< [1] of a particle over its radius
    double slack = 0.0;         ///< [m] travel that the candidate list allows beyond the tolerance
    std::int64_t interval = 0;  ///< cycles between renewals; 0 = displacement trigger
    bool brute_force = false;   ///< every pair is a contact object for ever (reference engine)

    /// Travel of one particle that the list of contacts that may touch soon allows [m], given the
    /// largest travel of the last step.
    double soon_travel(double last_step, double smallest_radius) const {
        return std::max(soon_steps * last_step, 1e-3 * smallest_radius);
    }

    /// Travel of the smallest particle that the list of contact objects allows [m]: its tolerance,
    /// less what the soon list looks ahead, so that a contact counts for the step before it can
    /// act. Where steps are that long (very soft contacts), half the tolerance.
    double near_travel(double soon_limit, double smallest_radius) const {
        const double whole = tolerance * smallest_radius;
        return std::max(whole - soon_limit, 0.5 * whole);
    }

    /// Steps at the present speed that a list of soon contacts should last. More steps mean fewer
    /// renewals, longer lists, and a smaller automatic step (share/doc/decisions/0004).
    static constexpr double soon_steps = 2.0;
};

/// What an update renewed.
enum class Renewal { none, soon, objects };

class PairContacts {
public:
    PairContacts() = default;
    PairContacts(const SearchSettings& settings, int history_size);

    /// Other laws from here on: column c of the history takes over sources[c]; -1 starts from zero.
    void change_history(std::span<const int> sources);

    /// Adds the travel bound of one step, relative to the bed's frame.
    void add_travel(double bound);

    /// Renews the lists that are due, at the present positions.
    Renewal update(std::uint64_t cycle,
                   const ParticleState& particles,
                   const Vec3& bed_shift,
                   const Kernels& kernels);

    /// Finds the touching contacts; those that opened lose their history. True if the set changed.
    bool find_touching(const ParticleState& particles, const Kernels& kernels);

    /// Adds the forces of the touching contacts.
    void add_forces(ParticleState& particles,
                    const ContactTable& table,
                    double timestep,
                    bool records,
                    const Kernels& kernels);

    const PairList& objects() const { return contacts_; }

    /// Those that touch or may touch soon.
    const PairList& soon() const { return soon_; }

    /// Places in objects(), ascending.
    std::span<const Index> touching() const { return {touching_.data(), touching_count_}; }

    /// Of touching contact t; only where forces were added with records.
    const double* record(Index t) const {
        return records_.data() + static_cast<std::size_t>(t) * record_size;
    }

    Index candidate_count() const { return candidates_.count; }

    std::uint64_t late_count() const { return late_; }

    std::uint64_t renewals() const { return renewals_; }

    std::uint64_t candidate_builds() const { return builds_; }

    void save(Archive& archive) const;
    void load(const Archive& archive);

private:
    bool is_due(std::uint64_t cycle, const ParticleState& particles, const Vec3& bed_shift);
    void build_candidates(const ParticleState& particles, const Vec3& bed_shift);
    void renew(const ParticleState& particles, const Kernels& kernels);
    void renew_soon(const ParticleState& particles, const Kernels& kernels);
    void carry_over(const ParticleState& particles,
                    const PairList& old_list,
                    const std::vector<std::uint8_t>& old_active,
                    const Column<double>& old_history,
                    std::size_t old_stride);
    void collect_active();

    SearchSettings settings_;
    int history_size_ = 0;
    bool started_ = false;
    std::uint64_t last_cycle_ = 0;
    TravelClock near_clock_{true};
    TravelClock candidate_clock_;
    CandidateFinder finder_;
    PairList candidates_;
    PairList contacts_;
    PairList soon_;
    Column<Index> soon_place_;  ///< in contacts_
    double last_travel_ = 0.0;  ///< [m] bound of the last step
    double soon_travel_ = 0.0;  ///< [m] since the soon list was renewed
    double soon_limit_ = 0.0;
    Column<Index> found_;
    std::vector<std::uint8_t> active_;  ///< by contact: acted in the last step, or born overlapping
    Column<double> history_;            ///< columns of history_stride_
    std::size_t history_stride_ = 0;
    Column<Index> touching_, touched_before_;
    Index touching_count_ = 0, touched_before_count_ = 0;
    Column<double> records_;
    std::uint64_t late_ = 0, renewals_ = 0, builds_ = 0;
};

}  // namespace grainbench
