/// State of the particles of one realisation, in columns of packets of four doubles
/// (share/doc/decisions/0002-packets-of-four.md). Slots are in spatial order at the start, and
/// again when the engine sorts them; ids are in order of insertion, from 1.
#pragma once

#include "core/archive.hpp"
#include "core/insertion/insert.hpp"
#include "core/kernels/kernels.hpp"
#include "core/scene.hpp"
#include "core/state/aligned.hpp"
#include "core/state/periodic_box.hpp"
#include "core/state/population.hpp"

#include <algorithm>
#include <span>

namespace grainbench {

class ParticleState {
public:
    ParticleState() = default;

    /// \param density by species [kg/m^3]
    /// \param expected_radii of spheres that may come later [m]
    ParticleState(std::span<const Sphere> spheres,
                  std::span<const double> density,
                  std::span<const double> expected_radii = {});

    Index size() const { return size_; }

    ParticleView view();

    Vec3 position(Index slot) const { return vector(place(slot)); }

    double radius(Index slot) const { return place(slot)[3]; }

    /// At the half step that the last cycle used [m/s].
    Vec3 velocity(Index slot) const { return vector(velocity_packet(slot)); }

    Vec3 spin(Index slot) const { return vector(spin_packet(slot)); }

    /// Of all contacts, and gravity where inertia is scaled [N].
    Vec3 force(Index slot) const { return vector(load_packet(slot, force_packet)); }

    Vec3 torque(Index slot) const { return vector(load_packet(slot, torque_packet)); }

    double inverse_mass(Index slot) const { return velocity_packet(slot)[3]; }

    double inverse_inertia(Index slot) const { return load_packet(slot, torque_packet)[3]; }

    Index species(Index slot) const { return species_[slot]; }

    std::int64_t id(Index slot) const { return id_[slot]; }

    /// Gravitational mass [kg]; equals the inertial mass unless the step is density-scaled.
    double mass(Index slot) const { return mass_[slot]; }

    /// Slot of each id, ids ascending.
    std::span<const Index> slots_by_id() const { return slots_by_id_; }

    std::span<const double> positions() const { return position_; }

    /// Slots of one slab, a multiple of 64: slots are in layers along the longest side of the bed,
    /// and while they keep that order contacts join a slab with itself or the next one.
    Index slab_size() const { return slab_size_; }

    Index slab_count() const { return (size_ + slab_size_ - 1) / slab_size_; }

    /// Of all that are, were or may come [m].
    double smallest_radius() const { return smallest_radius_; }

    double largest_radius() const { return largest_radius_; }

    /// Ids that have been given out; ids are not used again.
    std::int64_t last_id() const { return last_id_; }

    /// The change that would put all slots in spatial order again.
    PopulationChange spatial_order() const;

    /// The change by which those in some slots go.
    /// \param leaving in ascending order
    PopulationChange departure_of(std::span<const Index> leaving) const;

    /// Lets particles go and others come, or have other slots.
    void change_population(const PopulationChange& change);

    /// Whether no load moves a particle (core/body/driven_groups.hpp).
    bool is_driven(Index slot) const { return inverse_mass(slot) == 0.0; }

    /// Whether any particle is, or was, driven.
    bool has_driven() const { return has_driven_; }

    void set_driven(Index slot, bool driven);

    void set_position(Index slot, const Vec3& position) { set_vector(place(slot), position); }

    void set_velocity(Index slot, const Vec3& velocity) {
        set_vector(velocity_packet(slot), velocity);
    }

    void set_spin(Index slot, const Vec3& spin) { set_vector(spin_packet(slot), spin); }

    /// Rows with particles or images of particles beyond periodic boundaries; images come last.
    Index row_count() const { return size_ + static_cast<Index>(images_.size()); }

    bool has_images() const { return !images_.empty(); }

    /// The particle that a row is, or is an image of.
    Index owner(Index row) const { return row < size_ ? row : images_[row - size_].owner; }

    /// Lets the scene repeat itself. Call it before anything else.
    void make_periodic(const PeriodicBox& box);

    const PeriodicBox& box() const { return box_; }

    /// Puts all particles into the periodic box and makes the images of those that are within
    /// `margin` [m] of its ends.
    void renew_images(double margin);

    /// Lets all particles count as loaded, whether they are or not.
    void mark_all_loaded() { std::fill_n(loaded_.begin(), row_count(), std::uint8_t{1}); }

    /// Lets images follow their owners.
    void move_images();

    /// Hands forces and torques of images to their owners.
    void fold_images();

    /// As if the particle had never been put back into the periodic box [m].
    Vec3 unwrapped(Index slot) const {
        return !box_.is_periodic() ? position(slot)
                                   : position(slot) + box_.way({wraps_[3 * std::size_t{slot}],
                                                                wraps_[3 * std::size_t{slot} + 1],
                                                                wraps_[3 * std::size_t{slot} + 2]});
    }

    /// Sets the inertial mass to factor * mass and keeps the momentum.
    void scale_inertia(Index slot, double factor);

    /// Sets the force to weight, before contacts are added.
    void load_weight(const Vec3& gravity);

    /// Adds weight to the force.
    void add_weight(const Vec3& gravity);

    void save(Archive& archive) const;

    /// \param may_differ whether other particles may be there than at the start
    void load(const Archive& archive, bool may_differ = false);

private:
    double* place(Index slot) { return position_.data() + 4 * std::size_t{slot}; }

    const double* place(Index slot) const { return position_.data() + 4 * std::size_t{slot}; }

    double* velocity_packet(Index slot) { return velocity_.data() + 4 * std::size_t{slot}; }

    const double* velocity_packet(Index slot) const {
        return velocity_.data() + 4 * std::size_t{slot};
    }

    double* spin_packet(Index slot) { return spin_.data() + 4 * std::size_t{slot}; }

    const double* spin_packet(Index slot) const { return spin_.data() + 4 * std::size_t{slot}; }

    double* load_packet(Index slot, LoadPacket which) {
        return loads_.data() + load_row * slot + which;
    }

    const double* load_packet(Index slot, LoadPacket which) const {
        return loads_.data() + load_row * slot + which;
    }

    static Vec3 vector(const double* packet) { return {packet[0], packet[1], packet[2]}; }

    static void set_vector(double* packet, const Vec3& v) {
        packet[0] = v.x;
        packet[1] = v.y;
        packet[2] = v.z;
    }

    static void set_packet(double* packet, const Vec3& v, double fourth) {
        set_vector(packet, v);
        packet[3] = fourth;
    }

    void put(Index slot, const Sphere& sphere, std::int64_t id);
    void resize(Index size);
    void resize_rows(std::size_t kept, std::size_t rows);
    void set_images(std::vector<Image> images);
    void load_images(const Archive& archive);
    void order_by_id();

    Index size_ = 0;
    Index slab_size_ = 64;
    bool has_driven_ = false;
    PeriodicBox box_;
    std::vector<Image> images_;
    std::vector<double> wraps_;  ///< [1] by slot and axis: periods put back; empty if not periodic
    double smallest_radius_ = 0.0;
    double largest_radius_ = 0.0;
    Column<double> position_;  ///< packets
    Column<double> velocity_;  ///< packets
    Column<double> spin_;      ///< packets
    Column<double> loads_;     ///< rows of packets, see LoadPacket
    Column<std::uint8_t> loaded_;
    std::vector<double> density_;  ///< [kg/m^3] by species
    std::int64_t last_id_ = 0;
    std::vector<double> mass_;  ///< [kg]
    std::vector<Index> species_;
    std::vector<std::int64_t> id_;
    std::vector<Index> slots_by_id_;
};

}  // namespace grainbench
