/// Contacts between particles: candidates, contact objects and touching contacts, each a part of
/// the one before. Lists are in lexicographic order of (i, j), so that history is carried over in
/// one sweep and forces are summed in one fixed order. In large scenes that order is by slabs of
/// slots: first the contacts of all even slabs, then those of the odd ones. A contact of a slab
/// joins it with itself or the next one, so slabs of one kind never write to one particle, and
/// threads may share them.
#pragma once

#include "core/contact/contact_objects.hpp"
#include "core/contact/contact_records.hpp"
#include "core/contact/contact_table.hpp"
#include "core/contact/touch_finder.hpp"
#include "core/search/candidates.hpp"
#include "core/search/list_clock.hpp"

namespace grainbench {

class PairContacts {
public:
    PairContacts() = default;
    PairContacts(const SearchSettings& settings, int history_size);

    /// Other laws from here on: column c of the history takes over sources[c]; -1 starts from zero.
    void change_history(std::span<const int> sources) { objects_.change_history(sources); }

    /// Others may touch than the lists allow for; they are made anew before the next step.
    void expire(const ParticleState& particles) { clock_.expire(particles); }

    /// Particles have other slots; lists are made anew before the next step.
    void change_population(const PopulationChange& change,
                           const ParticleState& after,
                           const ContactTable& table);

    /// Mean of j - i over the contact objects [1]: how far apart in memory their particles are.
    double mean_slot_distance() const;

    /// Adds the travel bound of one step, relative to the bed's frame.
    void add_travel(double bound, double fall);

    bool look_ahead_is_due() const { return clock_.look_ahead_is_due(); }

    /// Which lists are due at the present positions.
    /// \param looks_ahead see ListClock::due
    Renewal due(std::uint64_t cycle,
                bool looks_ahead,
                const ParticleState& particles,
                const Vec3& bed_shift,
                const Kernels& kernels);

    /// Call before images of particles are made anew; renew the candidates afterwards.
    void forget_images(const ParticleState& particles) {
        objects_.forget_images(RowOwners(particles));
    }

    /// Distance of centres up to which pairs may be candidates [m].
    double candidate_reach(const ParticleState& particles) const;

    /// Renews the lists that are due.
    void renew(Renewal due,
               std::uint64_t cycle,
               const ParticleState& particles,
               const Vec3& bed_shift,
               const Kernels& kernels);

    /// Finds the touching contacts; those that opened lose their history. True if the set changed.
    /// \param reach gap up to which contacts count as touching [m]
    /// \param looks_ahead whether look_ahead() is wanted as well
    bool find_touching(const ParticleState& particles,
                       double reach,
                       bool looks_ahead,
                       const Kernels& kernels,
                       const Workers& workers = {});

    /// Adds the forces of the touching contacts.
    void add_forces(ParticleState& particles,
                    const ContactTable& table,
                    double timestep,
                    Records records,
                    const Kernels& kernels,
                    const Workers& workers = {});

    /// Marks the objects that touch or may touch within a few steps (ListClock).
    void look_ahead(const ParticleState& particles,
                    double reach,
                    const Kernels& kernels,
                    const Workers& workers = {}) {
        test_ahead(particles, reach, kernels, workers);
    }

    /// Adds to the sums for the stable step the contacts of the last look-ahead, or only those that
    /// touch.
    void add_steps(ParticleState& particles,
                   const ContactTable& table,
                   bool touching_only,
                   const StepSums& sums,
                   const Kernels& kernels,
                   const Workers& workers = {});

    /// Contact objects, and where particles are fast some that may soon be.
    const PairList& objects() const { return objects_.list(); }

    /// Contact objects: pairs within the detection tolerance now.
    std::size_t compute_object_count(const ParticleState& particles, const Kernels& kernels) const;

    /// By place in objects(), ascending.
    std::span<const TouchingContact> touching() const { return objects_.touching(); }

    /// Of touching contact t; only where forces were added with all records.
    const double* record(Index t) const { return records_.row(t); }

    /// Elastic energy of touching contact t [J]; only where forces were added with any records.
    double stored_energy(Index t) const { return records_.stored(t); }

    Index candidate_count() const { return candidates_.count; }

    std::uint64_t late_count() const { return late_; }

    std::uint64_t renewals() const { return renewals_; }

    std::uint64_t candidate_builds() const { return builds_; }

    /// \param records which of the last forces are needed again
    void save(Archive& archive, Records records) const;
    void load(const Archive& archive, const ParticleState& particles, Records records);

    /// Whether there is one record for each touching contact.
    bool has_all_records() const { return records_.has_rows(touching().size()); }

private:
    void build_candidates(const ParticleState& particles, const Kernels& kernels);
    void renew_objects(const ParticleState& particles, const Kernels& kernels);
    void leave_one_of_images(const ParticleState& particles);
    void cut_into_slabs(const ParticleState& particles);
    void adopt_late_contacts(const ParticleState& particles);

    /// Which objects touch. False if they are those of the last test.
    bool test(const ParticleState& particles,
              double reach,
              const Kernels& kernels,
              const Workers& workers);

    /// Sets counts_ too.
    bool test_ahead(const ParticleState& particles,
                    double reach,
                    const Kernels& kernels,
                    const Workers& workers);

    template <class Act>
    void for_each_slab(const Workers& workers, const Act& act) const;

    /// First touching contact of a slab, or of those behind it.
    std::size_t first_touching(std::size_t slab) const;

    ListClock clock_;
    CandidateFinder finder_;
    PairList candidates_;
    ContactObjects objects_;
    std::vector<std::uint64_t> within_;  ///< bit by candidate: within reach of an object
    TouchFinder touch_;                  ///< of the objects
    std::vector<std::uint64_t> counts_;  ///< bit by object: counts for the stable step
    bool counts_are_doubtful_ = false;   ///< they are the pairs in doubt
    PairSelection counting_;             ///< objects whose sums were asked for last
    bool just_renewed_ = false;
    std::vector<Index> slab_start_;  ///< by slab: first place; one more at the end
    ContactRecords records_;
    std::uint64_t late_ = 0, renewals_ = 0, builds_ = 0;
};

}  // namespace grainbench
