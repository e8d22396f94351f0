/// Contacts between particles: the objects that exist (touching or near), their history, and which of
/// them touch now. Lists are in lexicographic order of (i, j), so that history is carried over in one
/// sweep and forces are summed in one fixed order.
#pragma once

#include "core/contact/contact_table.hpp"
#include "core/search/candidates.hpp"
#include "core/search/travel_clock.hpp"

namespace grainbench {

/// How contact objects come and go; all lengths [m].
struct SearchSettings {
    double tolerance = 0.0625;  ///< [1] of a particle over its radius
    double slack = 0.0;         ///< travel that the candidate list allows beyond the tolerance
    std::int64_t interval = 0;  ///< cycles between renewals; 0 = displacement trigger
    bool brute_force = false;   ///< every pair is a contact object for ever (reference engine)
};

class PairContacts {
public:
    PairContacts() = default;
    PairContacts(const SearchSettings& settings, int history_size);

    /// Other laws from here on: column c of the history takes over sources[c]; -1 starts from zero.
    void change_history(std::span<const int> sources);

    /// Adds the travel bound of one step, relative to the bed's frame.
    void add_travel(double bound);

    /// Renews the list if it is due. True if it was.
    bool update(std::uint64_t cycle, ParticleState& particles, const Vec3& bed_shift,
                const Kernels& kernels);

    /// Finds the touching contacts; those that opened lose their history. True if the set changed.
    bool find_touching(const ParticleState& particles, const Kernels& kernels);

    /// Adds the forces of the touching contacts.
    void add_forces(ParticleState& particles, const ContactTable& table, double timestep,
                    bool records, const Kernels& kernels);

    const PairList& objects() const { return contacts_; }

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
    void carry_over(const ParticleState& particles, const PairList& old_list,
                    const std::vector<std::uint8_t>& old_active, const Column<double>& old_history,
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
    std::vector<std::uint8_t> active_;  ///< by contact: acted in the last step, or born overlapping
    Column<double> history_;            ///< columns of history_stride_
    std::size_t history_stride_ = 0;
    Column<Index> touching_, touched_before_;
    Index touching_count_ = 0, touched_before_count_ = 0;
    Column<double> records_;
    std::uint64_t late_ = 0, renewals_ = 0, builds_ = 0;
};

}  // namespace grainbench
