#include "core/state/particle_state.hpp"

#include <algorithm>
#include <numeric>

namespace grainbench {

namespace {

/// Order of the spheres along x within columns along y and z of cells of the largest diameter, so
/// that neighbours in space are near in memory.
std::vector<Index> spatial_order(std::span<const Sphere> spheres, double cell) {
    std::vector<Index> order(spheres.size());
    std::iota(order.begin(), order.end(), Index{0});
    const auto key = [&](Index n) {
        const Vec3& p = spheres[n].position;
        return std::array{std::floor(p.z / cell), std::floor(p.y / cell), std::floor(p.x / cell)};
    };
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return key(a) < key(b); });
    return order;
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
    const std::vector<Index> order =
        spatial_order(spheres, 2.0 * std::max(largest_radius_, 1e-300));
    for (Index slot = 0; slot < size_; ++slot) {
        const Index origin = order[slot];
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
