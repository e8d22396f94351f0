#include "core/state/particle_state.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace grainbench {

namespace {

/// The spheres in layers of cells along the longest side of the bed, and within a layer in rows
/// along the shortest: neighbours in space are near in memory, and contacts reach few layers ahead.
struct SpatialOrder {
    std::vector<Index> origin;  ///< by slot: place in the given order
    Index largest_layer = 0;    ///< spheres

    SpatialOrder(std::span<const Vec3> positions, double cell) : origin(positions.size()) {
        std::iota(origin.begin(), origin.end(), Index{0});
        if (positions.empty()) {
            return;
        }
        const auto along = [](const Vec3& v) { return std::array{v.x, v.y, v.z}; };
        std::array<double, 3> low = along(positions.front());
        std::array<double, 3> high = low;
        for (const Vec3& position : positions) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                low[axis] = std::min(low[axis], along(position)[axis]);
                high[axis] = std::max(high[axis], along(position)[axis]);
            }
        }
        std::array<std::size_t, 3> axes{2, 1, 0};
        std::stable_sort(axes.begin(), axes.end(), [&](std::size_t a, std::size_t b) {
            return high[a] - low[a] > high[b] - low[b];
        });
        std::vector<std::array<double, 3>> key;
        for (const Vec3& position : positions) {
            const std::array<double, 3> p = along(position);
            key.push_back({std::floor((p[axes[0]] - low[axes[0]]) / cell),
                           std::floor((p[axes[1]] - low[axes[1]]) / cell),
                           std::floor((p[axes[2]] - low[axes[2]]) / cell)});
        }
        std::stable_sort(
            origin.begin(), origin.end(), [&](Index a, Index b) { return key[a] < key[b]; });
        Index first = 0;
        for (Index slot = 0; slot < origin.size(); ++slot) {
            first = key[origin[slot]][0] > key[origin[first]][0] ? slot : first;
            largest_layer = std::max(largest_layer, slot - first + 1);
        }
    }
};

/// Slots per slab: three layers, since contacts may reach across two. Where that makes only a few
/// slabs the bed is one.
Index slab_size_of(Index size, Index largest_layer) {
    const std::size_t wanted = std::max<std::size_t>(1024, 3 * std::size_t{largest_layer});
    const std::size_t slab = 8 * wanted > size ? size : wanted;
    return static_cast<Index>((std::max<std::size_t>(slab, 1) + 63) / 64 * 64);
}

double inverse_inertia_of(double mass, double radius) {
    return 1.0 / (0.4 * mass * radius * radius);
}

/// Packets of the loads in a checkpoint.
constexpr std::array<std::pair<const char*, LoadPacket>, 2> load_names{
    {{"particles/force", force_packet}, {"particles/torque", torque_packet}}};

std::vector<double> plain(const Column<double>& column) {
    return {column.begin(), column.end()};
}

template <class T>
void restore(Column<T>& column, const Archive& archive, const std::string& name) {
    const std::vector<T>& from = archive.get<T>(name, column.size());
    std::copy(from.begin(), from.end(), column.begin());
}

}  // namespace

ParticleState::ParticleState(std::span<const Sphere> spheres,
                             std::span<const double> density,
                             std::span<const double> expected_radii)
    : density_(density.begin(), density.end()),
      last_id_(static_cast<std::int64_t>(spheres.size())) {
    resize(static_cast<Index>(spheres.size()));
    const auto expect = [&](double radius) {
        largest_radius_ = std::max(largest_radius_, radius);
        smallest_radius_ = smallest_radius_ == 0.0 ? radius : std::min(smallest_radius_, radius);
    };
    for (const Sphere& sphere : spheres) {
        expect(sphere.radius);
    }
    std::for_each(expected_radii.begin(), expected_radii.end(), expect);
    std::vector<Vec3> positions;
    for (const Sphere& sphere : spheres) {
        positions.push_back(sphere.position);
    }
    const SpatialOrder order(positions, 2.0 * std::max(largest_radius_, 1e-300));
    slab_size_ = slab_size_of(size_, order.largest_layer);
    for (Index slot = 0; slot < size_; ++slot) {
        const Index origin = order.origin[slot];
        put(slot, spheres[origin], static_cast<std::int64_t>(origin) + 1);
    }
    order_by_id();
}

/// Rows from `kept` on hold zeros.
void ParticleState::resize_rows(std::size_t kept, std::size_t rows) {
    const auto resize = [&](auto& column, std::size_t row_size) {
        column.resize(row_size * kept);
        column.resize(row_size * rows);
    };
    resize(position_, 4);
    resize(velocity_, 4);
    resize(spin_, 4);
    resize(loads_, load_row);
    resize(loaded_, 1);
}

/// Rows that are new hold zeros.
void ParticleState::resize(Index size) {
    size_ = size;
    const std::size_t padded = (std::size_t{size} + 7) / 8 * 8;
    resize_rows(size, padded);
    mass_.resize(size);
    species_.resize(size);
    id_.resize(size);
}

void ParticleState::put(Index slot, const Sphere& sphere, std::int64_t id) {
    const double r = sphere.radius;
    const double mass = sphere_mass(density_[sphere.species], r);
    set_packet(place(slot), sphere.position, r);
    set_packet(velocity_packet(slot), sphere.velocity, 1.0 / mass);
    set_packet(spin_packet(slot), sphere.angular_velocity, static_cast<double>(sphere.species));
    set_packet(load_packet(slot, torque_packet), {}, inverse_inertia_of(mass, r));
    mass_[slot] = mass;
    species_[slot] = sphere.species;
    id_[slot] = id;
}

void ParticleState::order_by_id() {
    slots_by_id_.resize(size_);
    std::iota(slots_by_id_.begin(), slots_by_id_.end(), Index{0});
    std::sort(slots_by_id_.begin(), slots_by_id_.end(), [&](Index a, Index b) {
        return id_[a] < id_[b];
    });
}

void ParticleState::change_population(const PopulationChange& change) {
    set_images({});
    const bool was_one_slab = slab_count() <= 1;
    position_ = renumbered(position_, change, 0.0, 4);
    velocity_ = renumbered(velocity_, change, 0.0, 4);
    spin_ = renumbered(spin_, change, 0.0, 4);
    loads_ = renumbered(loads_, change, 0.0, load_row);
    loaded_ = renumbered(loaded_, change);
    mass_ = renumbered(mass_, change);
    species_ = renumbered(species_, change);
    id_ = renumbered(id_, change);
    if (box_.is_periodic()) {
        wraps_ = renumbered(wraps_, change, 0.0, 3);
    }
    resize(static_cast<Index>(change.size_after()));
    for (std::size_t n = 0; n < change.newcomers.size(); ++n) {
        put(static_cast<Index>(size_ - change.newcomers.size() + n),
            change.newcomers[n],
            ++last_id_);
    }
    if (change.slab_size > 0) {
        slab_size_ = change.slab_size;
    } else if (was_one_slab) {
        slab_size_ = std::max(slab_size_, (size_ + 63) / 64 * 64);
    }
    order_by_id();
}

PopulationChange ParticleState::spatial_order() const {
    std::vector<Vec3> positions;
    for (Index slot = 0; slot < size_; ++slot) {
        positions.push_back(box_.wrapped(position(slot)));
    }
    const SpatialOrder order(positions, 2.0 * std::max(largest_radius_, 1e-300));
    PopulationChange change;
    change.slot_after.resize(size_);
    for (Index slot = 0; slot < size_; ++slot) {
        change.slot_after[order.origin[slot]] = slot;
    }
    change.slab_size = slab_size_of(size_, order.largest_layer);
    return change;
}

PopulationChange ParticleState::departure_of(std::span<const Index> leaving) const {
    PopulationChange change;
    change.slot_after.resize(size_);
    auto next_to_leave = leaving.begin();
    Index next = 0;
    for (Index slot = 0; slot < size_; ++slot) {
        if (next_to_leave == leaving.end() || *next_to_leave != slot) {
            change.slot_after[slot] = next++;
            continue;
        }
        ++next_to_leave;
        change.slot_after[slot] = PopulationChange::gone;
        change.leavers.push_back({.species = species(slot),
                                  .radius = radius(slot),
                                  .position = box_.wrapped(position(slot)),
                                  .velocity = velocity(slot),
                                  .angular_velocity = spin(slot)});
    }
    return change;
}

ParticleView ParticleState::view() {
    return {position_.data(),
            velocity_.data(),
            spin_.data(),
            loads_.data(),
            loaded_.data(),
            size_,
            loaded_.size()};
}

void ParticleState::set_driven(Index slot, bool driven) {
    const double r = radius(slot);
    const double mass = mass_[slot];
    velocity_packet(slot)[3] = driven ? 0.0 : 1.0 / mass;
    load_packet(slot, torque_packet)[3] = driven ? 0.0 : inverse_inertia_of(mass, r);
    has_driven_ = has_driven_ || driven;
}

void ParticleState::make_periodic(const PeriodicBox& box) {
    box_ = box;
    wraps_.assign(3 * std::size_t{size_}, 0.0);
}

/// Rows of the old images are overwritten; new ones hold no loads.
void ParticleState::set_images(std::vector<Image> images) {
    images_ = std::move(images);
    const std::size_t rows = row_count();
    const std::size_t padded = (rows + 7) / 8 * 8;
    resize_rows(size_, padded);
}

void ParticleState::renew_images(double margin) {
    std::vector<Image> images;
    std::vector<Vec3> shifts;
    for (Index slot = 0; slot < size_; ++slot) {
        const auto periods = box_.periods_from(position(slot));
        if (periods != std::array<double, 3>{}) {
            set_position(slot, position(slot) - box_.way(periods));
            for (std::size_t axis = 0; axis < 3; ++axis) {
                wraps_[3 * std::size_t{slot} + axis] += periods[axis];
            }
        }
        shifts.clear();
        box_.collect_shifts(position(slot), margin, shifts);
        for (const Vec3& shift : shifts) {
            images.push_back({.owner = slot, .shift = shift});
        }
    }
    set_images(std::move(images));
    move_images();
}

void ParticleState::move_images() {
    for (Index row = size_; row < row_count(); ++row) {
        const Image& image = images_[row - size_];
        std::copy_n(velocity_packet(image.owner), 4, velocity_packet(row));
        std::copy_n(spin_packet(image.owner), 4, spin_packet(row));
        set_packet(place(row), position(image.owner) + image.shift, radius(image.owner));
        load_packet(row, torque_packet)[3] = load_packet(image.owner, torque_packet)[3];
    }
}

void ParticleState::fold_images() {
    for (Index row = size_; row < row_count(); ++row) {
        if (loaded_[row] == 0) {
            continue;
        }
        const Index owner = images_[row - size_].owner;
        for (const LoadPacket which : {force_packet, torque_packet}) {
            set_vector(load_packet(owner, which),
                       vector(load_packet(owner, which)) + vector(load_packet(row, which)));
            set_vector(load_packet(row, which), {});
        }
        loaded_[owner] = 1;
        loaded_[row] = 0;
    }
}

void ParticleState::scale_inertia(Index slot, double factor) {
    if (is_driven(slot)) {
        return;
    }
    const double old = inverse_mass(slot);
    const double inverse = 1.0 / (factor * mass_[slot]);
    const double r = radius(slot);
    const double ratio = inverse / old;  // keeps m v and I omega
    double* v = velocity_packet(slot);
    double* w = spin_packet(slot);
    for (int c = 0; c < 3; ++c) {
        v[c] *= ratio;
        w[c] *= ratio;
    }
    v[3] = inverse;
    load_packet(slot, torque_packet)[3] = inverse / (0.4 * r * r);
}

void ParticleState::load_weight(const Vec3& gravity) {
    for (Index slot = 0; slot < size_; ++slot) {
        set_vector(load_packet(slot, force_packet), mass_[slot] * gravity);
        loaded_[slot] = 1;
    }
}

void ParticleState::add_weight(const Vec3& gravity) {
    for (Index slot = 0; slot < size_; ++slot) {
        set_vector(load_packet(slot, force_packet), force(slot) + mass_[slot] * gravity);
        loaded_[slot] = 1;
    }
}

void ParticleState::save(Archive& archive) const {
    archive.put("particles/position", plain(position_));
    archive.put("particles/velocity", plain(velocity_));
    archive.put("particles/spin", plain(spin_));
    for (const auto& [name, which] : load_names) {
        std::vector<double> packets;
        packets.reserve(position_.size());
        for (std::size_t at = which; at < loads_.size(); at += load_row) {
            packets.insert(packets.end(), &loads_[at], &loads_[at] + 4);
        }
        archive.put(name, std::move(packets));
    }
    archive.put("particles/loaded", std::vector<std::uint8_t>(loaded_.begin(), loaded_.end()));
    archive.put("particles/id", std::vector<std::uint64_t>(id_.begin(), id_.end()));
    archive.put("particles/species", species_);
    if (box_.is_periodic()) {
        std::vector<Index> owners;
        std::vector<double> shifts;
        for (const Image& image : images_) {
            owners.push_back(image.owner);
            shifts.insert(shifts.end(), {image.shift.x, image.shift.y, image.shift.z});
        }
        archive.put("particles/image_owner", owners);
        archive.put("particles/image_shift", shifts);
        archive.put("particles/wraps", wraps_);
    }
    archive.put("particles/counts",
                std::vector<std::uint64_t>{slab_size_, static_cast<std::uint64_t>(last_id_)});
}

void ParticleState::load_images(const Archive& archive) {
    const auto& owners = archive.get<Index>("particles/image_owner");
    const auto& shifts = archive.get<double>("particles/image_shift", 3 * owners.size());
    std::vector<Image> images;
    for (std::size_t k = 0; k < owners.size(); ++k) {
        Archive::require(owners[k] < size_, "particles/image_owner");
        images.push_back({owners[k], {shifts[3 * k], shifts[3 * k + 1], shifts[3 * k + 2]}});
    }
    set_images(std::move(images));
    wraps_ = archive.get<double>("particles/wraps", 3 * std::size_t{size_});
}

void ParticleState::load(const Archive& archive, bool may_differ) {
    const auto& id = archive.get<std::uint64_t>("particles/id");
    const auto& species = archive.get<Index>("particles/species", id.size());
    const auto& counts = archive.get<std::uint64_t>("particles/counts", 2);
    if (may_differ) {
        resize(static_cast<Index>(id.size()));
        last_id_ = static_cast<std::int64_t>(counts[1]);
    } else if (id.size() != size_) {
        throw_bad_input({.what = "the checkpoint holds another number of particles",
                         .where = "checkpoint",
                         .likely_cause = "the scene has changed since it was written",
                         .next_step = "run the scene again without --resume"});
    }
    slab_size_ = static_cast<Index>(counts[0]);
    Archive::require(slab_size_ > 0 && slab_size_ % 64 == 0, "particles/counts");
    if (box_.is_periodic()) {
        load_images(archive);
    }
    restore(position_, archive, "particles/position");
    restore(velocity_, archive, "particles/velocity");
    restore(spin_, archive, "particles/spin");
    for (const auto& [name, which] : load_names) {
        const auto& packets = archive.get<double>(name, position_.size());
        for (std::size_t row = 0; 4 * row < packets.size(); ++row) {
            std::copy_n(&packets[4 * row], 4, &loads_[load_row * row + which]);
        }
    }
    restore(loaded_, archive, "particles/loaded");
    Archive::require(
        std::all_of(loaded_.begin(), loaded_.end(), [](std::uint8_t flag) { return flag <= 1; }),
        "particles/loaded");
    for (Index slot = 0; slot < size_; ++slot) {
        Archive::require(species[slot] < density_.size(), "particles/species");
        mass_[slot] = sphere_mass(density_[species[slot]], radius(slot));
        species_[slot] = species[slot];
        id_[slot] = static_cast<std::int64_t>(id[slot]);
        has_driven_ = has_driven_ || is_driven(slot);
    }
    order_by_id();
    const bool ids_fit =
        size_ == 0 || (id_[slots_by_id_.front()] >= 1 && id_[slots_by_id_.back()] <= last_id_);
    const auto same_id = [&](Index a, Index b) { return id_[a] == id_[b]; };
    Archive::require(
        ids_fit && std::adjacent_find(slots_by_id_.begin(), slots_by_id_.end(), same_id) ==
                       slots_by_id_.end(),
        "particles/id");
}

}  // namespace grainbench
