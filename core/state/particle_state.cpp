#include "core/state/particle_state.hpp"

#include <algorithm>
#include <numeric>

namespace grainbench {

namespace {

/// The spheres in layers of cells along the longest side of the bed, and within a layer in rows
/// along the shortest: neighbours in space are near in memory, and contacts reach few layers ahead.
struct SpatialOrder {
    std::vector<Index> origin;  ///< by slot: place in the given order
    Index largest_layer = 0;    ///< spheres

    SpatialOrder(std::span<const Sphere> spheres, double cell) : origin(spheres.size()) {
        std::iota(origin.begin(), origin.end(), Index{0});
        if (spheres.empty()) {
            return;
        }
        const auto along = [](const Vec3& v) { return std::array{v.x, v.y, v.z}; };
        std::array<double, 3> low = along(spheres.front().position);
        std::array<double, 3> high = low;
        for (const Sphere& sphere : spheres) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                low[axis] = std::min(low[axis], along(sphere.position)[axis]);
                high[axis] = std::max(high[axis], along(sphere.position)[axis]);
            }
        }
        std::array<std::size_t, 3> axes{2, 1, 0};
        std::stable_sort(axes.begin(), axes.end(), [&](std::size_t a, std::size_t b) {
            return high[a] - low[a] > high[b] - low[b];
        });
        std::vector<std::array<double, 3>> key;
        for (const Sphere& sphere : spheres) {
            const std::array<double, 3> p = along(sphere.position);
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

void put_packet(Column<double>& column, Index slot, const Vec3& v, double fourth) {
    double* p = column.data() + 4 * static_cast<std::size_t>(slot);
    p[0] = v.x;
    p[1] = v.y;
    p[2] = v.z;
    p[3] = fourth;
}

std::vector<double> plain(const Column<double>& column) {
    return {column.begin(), column.end()};
}

template <class T>
void restore(Column<T>& column, const std::vector<T>& from) {
    if (column.size() != from.size()) {
        throw_bad_input({.what = "the checkpoint holds another number of particles",
                         .where = "checkpoint",
                         .likely_cause = "the scene has changed since it was written",
                         .next_step = "run the scene again without --resume"});
    }
    std::copy(from.begin(), from.end(), column.begin());
}

}  // namespace

ParticleState::ParticleState(std::span<const Sphere> spheres, std::span<const double> density)
    : size_(static_cast<Index>(spheres.size())) {
    const std::size_t padded = (spheres.size() + 7) / 8 * 8;
    for (Column<double>* column : {&position_, &velocity_, &spin_, &force_, &torque_}) {
        column->assign(4 * padded, 0.0);
    }
    loaded_.assign(padded, 0);
    mass_.resize(size_);
    species_.resize(size_);
    id_.resize(size_);
    slots_by_id_.resize(size_);
    for (const Sphere& sphere : spheres) {
        largest_radius_ = std::max(largest_radius_, sphere.radius);
        smallest_radius_ =
            smallest_radius_ == 0.0 ? sphere.radius : std::min(smallest_radius_, sphere.radius);
    }
    const SpatialOrder order(spheres, 2.0 * std::max(largest_radius_, 1e-300));
    slab_size_ = slab_size_of(size_, order.largest_layer);
    for (Index slot = 0; slot < size_; ++slot) {
        const Index origin = order.origin[slot];
        const Sphere& s = spheres[origin];
        const double mass = density[s.species] * 4.0 / 3.0 * pi * s.radius * s.radius * s.radius;
        const double inverse_inertia = 1.0 / (0.4 * mass * s.radius * s.radius);
        put_packet(position_, slot, s.position, s.radius);
        put_packet(velocity_, slot, s.velocity, 1.0 / mass);
        put_packet(spin_, slot, s.angular_velocity, static_cast<double>(s.species));
        put_packet(torque_, slot, {}, inverse_inertia);
        mass_[slot] = mass;
        species_[slot] = s.species;
        id_[slot] = static_cast<std::int64_t>(origin) + 1;
        slots_by_id_[origin] = slot;
    }
}

ParticleView ParticleState::view() {
    return {position_.data(),
            velocity_.data(),
            spin_.data(),
            force_.data(),
            torque_.data(),
            loaded_.data(),
            size_,
            loaded_.size()};
}

void ParticleState::scale_inertia(Index slot, double factor) {
    const double old = inverse_mass(slot);
    const double inverse = 1.0 / (factor * mass_[slot]);
    const double r = radius(slot);
    const double ratio = inverse / old;  // keeps m v and I omega
    double* v = velocity_.data() + 4 * static_cast<std::size_t>(slot);
    double* w = spin_.data() + 4 * static_cast<std::size_t>(slot);
    for (int c = 0; c < 3; ++c) {
        v[c] *= ratio;
        w[c] *= ratio;
    }
    v[3] = inverse;
    torque_[4 * std::size_t{slot} + 3] = inverse / (0.4 * r * r);
}

void ParticleState::load_weight(const Vec3& gravity) {
    for (Index slot = 0; slot < size_; ++slot) {
        put_packet(force_, slot, mass_[slot] * gravity, 0.0);
        loaded_[slot] = 1;
    }
}

void ParticleState::add_weight(const Vec3& gravity) {
    for (Index slot = 0; slot < size_; ++slot) {
        put_packet(force_, slot, force(slot) + mass_[slot] * gravity, 0.0);
        loaded_[slot] = 1;
    }
}

void ParticleState::save(Archive& archive) const {
    archive.put("particles/position", plain(position_));
    archive.put("particles/velocity", plain(velocity_));
    archive.put("particles/spin", plain(spin_));
    archive.put("particles/force", plain(force_));
    archive.put("particles/torque", plain(torque_));
    archive.put("particles/loaded", std::vector<std::uint8_t>(loaded_.begin(), loaded_.end()));
}

void ParticleState::load(const Archive& archive) {
    restore(position_, archive.get<double>("particles/position"));
    restore(velocity_, archive.get<double>("particles/velocity"));
    restore(spin_, archive.get<double>("particles/spin"));
    restore(force_, archive.get<double>("particles/force"));
    restore(torque_, archive.get<double>("particles/torque"));
    restore(loaded_, archive.get<std::uint8_t>("particles/loaded"));
}

}  // namespace grainbench
