/// Contacts of the particles with one wall: which patches are near, which touch now after the rule
/// of core/walls/surface.hpp, and the history that follows a particle from patch to patch.
#pragma once

#include "core/contact/contact_objects.hpp"
#include "core/contact/contact_records.hpp"
#include "core/contact/contact_table.hpp"
#include "core/contact/wall_candidates.hpp"
#include "core/search/list_clock.hpp"
#include "core/walls/wall_body.hpp"

#include <string>
#include <utility>
#include <vector>

namespace grainbench {

/// All loops over entries run in parts of whole particles, so that parts share nothing and the bits
/// do not depend on where they are cut.
class WallContacts {
public:
    WallContacts(const SearchSettings& settings, int history_size);

    /// Other laws from here on: column c of the history takes over sources[c]; -1 starts from zero.
    void change_history(std::span<const int> sources) { objects_.change_history(sources); }

    /// Others may touch than the lists allow for; they are made anew before the next step.
    void expire(const ParticleState& particles) { clock_.expire(particles); }

    /// Particles have other slots; lists are made anew before the next step.
    void change_population(const PopulationChange& change, const ParticleState& after);

    /// Adds the travel bound of one step, relative to the wall.
    void add_travel(double bound, double fall) { clock_.add_travel(bound, fall); }

    bool look_ahead_is_due() const { return clock_.look_ahead_is_due(); }

    /// Renews the lists that are due, at the present positions.
    /// \param looks_ahead see ListClock::due
    Renewal update(std::uint64_t cycle,
                   bool looks_ahead,
                   const ParticleState& particles,
                   const WallBody& wall,
                   const Kernels& kernels,
                   const Workers& workers);

    /// Marks the entries that touch or may touch within a few steps (ListClock).
    /// \param reach gap up to which contacts count as touching [m]
    void look_ahead(const ParticleState& particles,
                    const WallBody& wall,
                    double reach,
                    const Kernels& kernels,
                    const Workers& workers);

    /// No look-ahead follows the last one in its time.
    void end_look_ahead() { watches_all_ = true; }

    /// Finds the touching contacts and hands their history over. True if the set changed. Between
    /// look-aheads only what they marked is tested.
    /// \param reach gap up to which contacts count as touching [m]
    bool find_touching(const ParticleState& particles,
                       const WallBody& wall,
                       double reach,
                       const Kernels& kernels,
                       const Workers& workers);

    void add_forces(ParticleState& particles,
                    const WallBody& wall,
                    const ContactTable& table,
                    double timestep,
                    Records records,
                    const Kernels& kernels,
                    const Workers& workers);

    /// Adds to the sums for the stable step the contacts of the last look-ahead, or only those that
    /// touch.
    void add_steps(ParticleState& particles,
                   const WallBody& wall,
                   const ContactTable& table,
                   bool touching_only,
                   const StepSums& sums,
                   const Kernels& kernels,
                   const Workers& workers);

    Index touching_count() const { return static_cast<Index>(objects_.touching().size()); }

    Index particle(Index t) const { return objects_.list().i[place(t)]; }

    /// Unit vector from the particle to the wall.
    Vec3 normal(Index t) const {
        const double* geometry = objects_.extra(place(t));
        return {geometry[0], geometry[1], geometry[2]};
    }

    /// From the centre to the closest point of the wall [m].
    double distance(Index t) const { return objects_.extra(place(t))[3]; }

    /// Of the particle on the wall [N].
    Vec3 force(Index t) const {
        const double* force = force_.data() + 4 * std::size_t{t};
        return {force[0], force[1], force[2]};
    }

    /// Closest point of the wall [m].
    Vec3 point(const ParticleState& particles, Index t) const;

    const double* record(Index t) const { return records_.row(t); }

    double stored_energy(Index t) const { return records_.stored(t); }

    /// Contact objects: contacts within the detection tolerance, among the entries of the list.
    std::size_t compute_object_count(const ParticleState& particles, const WallBody& wall) const;

    std::uint64_t late_count() const { return late_; }

    /// \param records see PairContacts
    void save(Archive& archive, const std::string& name, Records records) const;
    void load(const Archive& archive,
              const std::string& name,
              const ParticleState& particles,
              const WallBody& wall,
              Records records);

    /// Whether there is one record for each touching contact.
    bool has_all_records() const { return records_.has_rows(touching_count()); }

private:
    struct Hit {
        Index place;
        Vec3 normal;
        double distance;
    };

    Index place(Index t) const { return objects_.touching()[t].place(); }

    /// Work on the entries of some particles, with room of its own.
    struct Part {
        Index first = 0;  ///< entries [first, last); whole words of the bits by entry
        Index last = 0;
        bool has_changed = false;
        std::vector<Index> near;     ///< places that may touch
        std::vector<Index> patches;  ///< of one particle
        std::vector<Index> opened;   ///< places
        std::vector<Hit> hits;       ///< by place
        std::vector<Hit> soon;       ///< by place: of the last look-ahead
        std::vector<Index> watched;  ///< places that may touch before the next look-ahead
        PairList watched_list;       ///< of them: particle, patch
        std::vector<std::uint64_t> watched_face, watched_doubt;
        Column<double> watched_height;
        Column<Index> step_particle;   ///< by contact that counts for the stable step
        Column<double> step_geometry;  ///< packet by contact: normal, distance
    };

    void renew(const ParticleState& particles,
               const WallBody& wall,
               const Kernels& kernels,
               const Workers& workers);
    void cut_into_parts();

    /// Asks the planes of the patches about the entries [first, last) of a list, for spheres of
    /// radius R + extra.
    PatchQuery query_of(const ParticleState& particles,
                        const WallBody& wall,
                        const PairList& list,
                        Index first,
                        Index last,
                        double extra) const;

    /// Sets the bits of the entries of a part that may touch spheres of radius R + extra.
    void test_all(const ParticleState& particles,
                  const WallBody& wall,
                  double extra,
                  const Kernels& kernels,
                  Part& part);

    /// The same, if they are among those that are watched.
    void test_watched(const ParticleState& particles,
                      const WallBody& wall,
                      double extra,
                      const Kernels& kernels,
                      Part& part);

    /// Fills the hits of a part with the contacts of spheres of radius R + extra among what a test
    /// has found near.
    void find_hits(const ParticleState& particles, const WallBody& wall, double extra, Part& part);
    void watch(Part& part) const;

    /// Where a test of the entries from `first` on, a multiple of 64, leaves its answers.
    PatchAnswers answers_from(Index first);
    Hit face_hit(const Surface& surface, Index place) const;
    static Hit to_space(Hit hit, const WallBody& wall);
    bool add_faces(const ParticleState& particles,
                   const WallBody& wall,
                   std::span<const Index> places,
                   Part& part) const;
    void resolve(const ParticleState& particles,
                 const WallBody& wall,
                 double extra,
                 std::span<const Index> places,
                 Part& part) const;

    /// Sets the bits of what touches now; true if they are not those that act.
    bool mark_hits(const Part& part);
    void hand_over(const Surface& surface, Part& part);
    void adopt_late_contacts(const Part& part);

    /// The contacts among touching() that are entries of a part.
    std::pair<Index, Index> touching_of(const Part& part) const;

    ListClock clock_;
    WallCandidates candidates_;
    ContactObjects objects_;  ///< particle, patch; extra packet: normal, distance
    bool just_renewed_ = false;
    bool watches_all_ = true;                        ///< no look-ahead since the last renewal
    std::vector<std::uint64_t> face_, doubt_, now_;  ///< bit by entry
    Column<double> height_;                          ///< [m] by entry
    std::vector<Part> parts_;
    Column<double> force_;
    ContactRecords records_;
    std::uint64_t late_ = 0;
};

}  // namespace grainbench
