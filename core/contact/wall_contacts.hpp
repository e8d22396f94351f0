/// Contacts of the particles with one wall: which patches are near, which touch now after the rule
/// of core/walls/surface.hpp, and the history that follows a particle from patch to patch.
#pragma once

#include "core/contact/pair_contacts.hpp"
#include "core/walls/wall_body.hpp"

#include <string>

namespace grainbench {

/// One contact object of a wall, for the stable step.
struct WallObject {
    Index particle;
    Vec3 normal;
};

class WallContacts {
public:
    WallContacts(const SearchSettings& settings, int history_size);

    /// Other laws from here on: column c of the history takes over sources[c]; -1 starts from zero.
    void change_history(std::span<const int> sources);

    void add_travel(double bound);

    /// Renews the lists that are due, at the present positions.
    Renewal update(std::uint64_t cycle,
                   const ParticleState& particles,
                   const WallBody& wall,
                   const Kernels& kernels);

    /// Finds the touching contacts and hands their history over. True if the set changed.
    bool find_touching(const ParticleState& particles,
                       const WallBody& wall,
                       const Kernels& kernels);

    void add_forces(ParticleState& particles,
                    const WallBody& wall,
                    const ContactTable& table,
                    double timestep,
                    bool records,
                    const Kernels& kernels);

    Index touching_count() const { return count_; }

    Index particle(Index t) const { return particle_[t]; }

    /// Unit vector from the particle to the wall.
    Vec3 normal(Index t) const { return column_vector(normal_, t); }

    /// Of the particle on the wall [N].
    Vec3 force(Index t) const { return column_vector(force_, t); }

    /// Closest point of the wall [m].
    Vec3 point(const ParticleState& particles, Index t) const;

    double distance(Index t) const { return distance_[t]; }

    const double* record(Index t) const {
        return records_.data() + static_cast<std::size_t>(t) * record_size;
    }

    /// Contact objects: within the detection tolerance at the last renewal.
    Index object_count() const { return object_count_; }

    /// Those that touch or may touch soon.
    std::span<const WallObject> soon() const { return soon_objects_; }

    std::uint64_t late_count() const { return late_; }

    void save(Archive& archive, const std::string& name) const;
    void load(const Archive& archive, const std::string& name);

private:
    Vec3 column_vector(const Column<double>& columns, Index t) const {
        return {columns[t], columns[stride_ + t], columns[2 * stride_ + t]};
    }

    bool is_due(std::uint64_t cycle, const ParticleState& particles, const WallBody& wall);
    void build_candidates(const ParticleState& particles, const WallBody& wall);
    void renew(const ParticleState& particles, const WallBody& wall, const Kernels& kernels);
    void renew_soon(const ParticleState& particles, const WallBody& wall, const Kernels& kernels);
    void reserve(std::size_t contacts);
    bool add_hits(const ParticleState& particles,
                  const WallBody& wall,
                  Index particle,
                  std::span<const WallHit> hits,
                  Index& before);

    /// Gives the contacts from `first_new` on the history of a contact before: of the same patch,
    /// else of a neighbour that they continue.
    void hand_over(const Surface& surface, Index first_new, Index first_before, Index last_before);
    void take_history(Index t, Index before);

    SearchSettings settings_;
    int history_size_ = 0;
    bool started_ = false;
    std::uint64_t last_cycle_ = 0;
    TravelClock near_clock_{true};
    TravelClock candidate_clock_;
    PairList candidates_;  ///< particle, patch
    PairList near_;        ///< particle, patch
    bool just_renewed_ = false;
    std::vector<std::uint8_t> fresh_;  ///< by near entry: not near before the last renewal
    Index object_count_ = 0;
    PairList soon_;             ///< particle, patch
    Column<Index> soon_place_;  ///< in near_
    std::vector<WallObject> soon_objects_;
    double last_travel_ = 0.0, soon_travel_ = 0.0, soon_limit_ = 0.0;
    Column<Index> found_;

    Index count_ = 0;
    std::size_t stride_ = 0;  ///< of all columns below
    Column<Index> particle_, patch_;
    Column<double> normal_, distance_, wall_velocity_, wall_spin_, entered_, history_, force_;
    Column<double> records_;
    Index count_before_ = 0;
    std::size_t stride_before_ = 0;
    Column<Index> particle_before_, patch_before_;
    Column<double> normal_before_, history_before_;
    std::vector<std::uint8_t> taken_;  ///< by contact before: history already handed over
    std::uint64_t late_ = 0;
};

}  // namespace grainbench
