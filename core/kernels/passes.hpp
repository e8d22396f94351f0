/// The hot passes, written once over lanes; included by one small file per instruction set, which
/// sets GRAINBENCH_ISA. Loads, gathers and scatters live here, laws never see memory.
#pragma once

#include "core/contact/law_table.hpp"
#include "core/kernels/kernels.hpp"
#include "core/simd/lanes.hpp"

namespace grainbench::GRAINBENCH_ISA {

/// Elementwise over packets, so plain loops that the compiler turns into whole vectors. Eight
/// running sums whatever the vector length keep the bits the same on every instruction set.
inline void move(MotionPass& pass) {
    const ParticleView& p = pass.particles;
    double fastest[8] = {};
    double sum[8] = {};
    const double drift[8] = {
        pass.drift, pass.drift, pass.drift, 0.0, pass.drift, pass.drift, pass.drift, 0.0};
    double* __restrict position = p.position;
    double* __restrict velocity = p.velocity;
    double* __restrict spin = p.spin;
    double* __restrict force = p.force;
    double* __restrict torque = p.torque;
    const double* __restrict inverse_mass = p.inverse_mass;
    const double* __restrict inverse_inertia = p.inverse_inertia;
    for (std::size_t k = 0; k < p.padded_size; k += 8) {
        for (std::size_t l = 0; l < 8; ++l) {
            const double v = velocity[k + l] +
                             (force[k + l] * inverse_mass[k + l] + pass.gravity[l]) * pass.kick;
            velocity[k + l] = v;
            position[k + l] += v * drift[l];
            spin[k + l] += torque[k + l] * inverse_inertia[k + l] * pass.kick;
            force[k + l] = 0.0;
            torque[k + l] = 0.0;
            sum[l] += v;
            const double relative = v - pass.frame[l];
            const double speed = relative < 0.0 ? -relative : relative;
            fastest[l] = fastest[l] < speed ? speed : fastest[l];
        }
    }
    for (int l = 0; l < 4; ++l) {
        pass.fastest[l] = fastest[l] < fastest[l + 4] ? fastest[l + 4] : fastest[l];
        pass.velocity_sum[l] = sum[l] + sum[l + 4];
    }
}

/// Appends first + l for each set bit l below `valid`.
inline Index append_bits(unsigned bits, Index first, Index valid, Index* found, Index count) {
    bits &= valid < width ? (1U << valid) - 1U : ~0U;
    while (bits != 0) {
        found[count++] = first + static_cast<Index>(__builtin_ctz(bits));
        bits &= bits - 1;
    }
    return count;
}

inline Index find_pairs(const ClosePairs& list) {
    const Pack scale(list.scale);
    const Pack extra(list.extra);
    Index count = 0;
    for (Index k = 0; k < list.count; k += width) {
        const Rows i(list.i + k);
        const Rows j(list.j + k);
        const Vec3Of<Pack> apart = j.vector(list.position) - i.vector(list.position);
        const Pack reach =
            scale * (i.packet(list.position, 3) + j.packet(list.position, 3)) + extra;
        const unsigned bits = bits_of(dot(apart, apart) <= reach * reach);
        count = append_bits(bits, k, list.count - k, list.found, count);
    }
    return count;
}

inline Index find_patches(const ClosePatches& list) {
    const Pack scale(list.scale);
    const Pack extra(list.extra);
    const Vec3Of<Pack> shift{Pack(list.shift[0]), Pack(list.shift[1]), Pack(list.shift[2])};
    const Vec3Of<Pack> centre{Pack(list.centre[0]), Pack(list.centre[1]), Pack(list.centre[2])};
    Vec3Of<Pack> row[3];
    for (int r = 0; r < 3; ++r) {
        row[r] = {Pack(list.rotation[3 * r]),
                  Pack(list.rotation[3 * r + 1]),
                  Pack(list.rotation[3 * r + 2])};
    }
    Index count = 0;
    for (Index k = 0; k < list.count; k += width) {
        const Rows particle(list.particle + k);
        const Rows patch(list.patch + k);
        Vec3Of<Pack> place = particle.vector(list.position) - shift;
        if (list.rotated) {
            const Vec3Of<Pack> arm = place - centre;
            place = centre + Vec3Of<Pack>{dot(row[0], arm), dot(row[1], arm), dot(row[2], arm)};
        }
        const Pack height =
            absolute(dot(patch.vector(list.planes), place) - patch.packet(list.planes, 3));
        const Pack reach = scale * particle.packet(list.position, 3) + extra;
        const unsigned bits = bits_of(height <= reach);
        count = append_bits(bits, k, list.count - k, list.found, count);
    }
    return count;
}

/// Motion of the bodies of a block of contacts.
struct Bodies {
    Vec3Of<Pack> velocity_i, velocity_j;
    Vec3Of<Pack> spin_i, spin_j;
    Pack lever_i, lever_j;  ///< [m] from the centres to the contact point along the normal
    Pack material_i, material_j;
    Pack inverse_mass_i, inverse_mass_j;
    Pack inactive;  ///< 1 where the contact did not act in the last step
};

/// Fills the parts of the geometry that the laws need.
template <class Laws>
void complete_geometry(const Bodies& b, Pack timestep, Geometry<Pack>& g) {
    g.timestep = timestep;
    if constexpr (contains(Laws::needs, Needs::effective_mass)) {
        g.effective_mass = Pack(1.0) / (b.inverse_mass_i + b.inverse_mass_j);
    }
    if constexpr (contains(Laws::needs, Needs::velocity)) {
        Vec3Of<Pack> relative = b.velocity_j - b.velocity_i;
        g.opening_speed = dot(relative, g.normal);
        if constexpr (contains(Laws::needs, Needs::spin)) {
            relative -= cross(b.lever_i * b.spin_i + b.lever_j * b.spin_j, g.normal);
            g.sliding_velocity = relative - dot(relative, g.normal) * g.normal;
            g.mean_spin = Pack(0.5) * dot(b.spin_i + b.spin_j, g.normal);
        }
    }
    if constexpr (contains(Laws::needs, Needs::entry)) {
        const Pack approach = absolute(g.opening_speed * timestep);
        const Mask partial = (g.overlap < approach) & (Pack{} < b.inactive);
        const Pack safe = select(partial, approach, Pack(1.0));
        g.entry = select(partial, g.overlap / safe, Pack(1.0));
    }
}

/// Folds the laws over a block. history_in and history_out hold Laws::history_size packs.
template <class Laws>
Load<Pack> apply_laws(const LawView& view,
                      const Bodies& b,
                      const Geometry<Pack>& g,
                      const Pack* history_in,
                      Pack* history_out) {
    const Pack pair = b.material_i * Pack(static_cast<double>(view.material_count)) + b.material_j;
    Load<Pack> load;
    load.slipping = Mask::all();
    Laws::for_each([&]<class Law, int first_value, int first_history>() {
        const auto values = values_of<Law, Pack>([&](int k) {
            const auto column = static_cast<std::size_t>(first_value + k) * view.value_stride;
            return look_up(view.values + column, pair);
        });
        Law::apply(values, g, history_in + first_history, history_out + first_history, load);
    });
    return load;
}

/// Total force on j.
template <class Laws>
Vec3Of<Pack> force_on_j(const Load<Pack>& load, const Geometry<Pack>& g) {
    Vec3Of<Pack> force = (load.normal + load.normal_damping) * g.normal;
    if constexpr (contains(Laws::needs, Needs::spin)) {
        force += load.shear + load.shear_damping;
    }
    return force;
}

/// Writes the records of `valid` contacts.
inline void keep_records(const Load<Pack>& load,
                         const Geometry<Pack>& g,
                         const Bodies& b,
                         Index valid,
                         double* records) {
    const Vec3Of<Pack> damping = load.normal_damping * g.normal + load.shear_damping;
    const Pack columns[record_size] = {damping.x,
                                       damping.y,
                                       damping.z,
                                       load.slip_work,
                                       load.stored,
                                       load.normal,
                                       load.shear.x,
                                       load.shear.y,
                                       load.shear.z,
                                       b.lever_i,
                                       b.lever_j,
                                       g.normal.x,
                                       g.normal.y,
                                       g.normal.z};
    double lanes[width];
    for (Index field = 0; field < record_size; ++field) {
        store(columns[field], lanes);
        for (Index l = 0; l < valid; ++l) {
            records[static_cast<std::size_t>(l) * record_size + field] = lanes[l];
        }
    }
}

/// Adds a packet to a row of a column of packets, or takes it away.
inline void add_packet(double* __restrict column, Index row, const double* __restrict packet) {
    double* to = column + 4 * static_cast<std::size_t>(row);
    for (int c = 0; c < 4; ++c) {
        to[c] += packet[c];
    }
}

inline void subtract_packet(double* __restrict column, Index row, const double* __restrict packet) {
    double* to = column + 4 * static_cast<std::size_t>(row);
    for (int c = 0; c < 4; ++c) {
        to[c] -= packet[c];
    }
}

// The passes are flattened: laws and helpers are one body with them, so that a block of contacts
// stays in registers from load to store.
template <class Laws, bool records>
[[gnu::flatten]] void pair_pass(const PairPass& pass) {
    constexpr int history_size = Laws::history_size;
    const ParticleView& p = pass.particles;
    const Pack timestep(pass.laws.timestep);
    for (Index first = 0; first < pass.touching_count; first += width) {
        const Index valid =
            pass.touching_count - first < width ? pass.touching_count - first : width;
        Index slot[width];
        Index row_i[width];
        Index row_j[width];
        double inactive[width];
        for (Index l = 0; l < width; ++l) {
            // Lanes past the end repeat the last contact; nothing of theirs is stored.
            slot[l] = pass.touching[first + (l < valid ? l : valid - 1)];
            row_i[l] = pass.i[slot[l]];
            row_j[l] = pass.j[slot[l]];
            inactive[l] = pass.active[slot[l]] != 0 ? 0.0 : 1.0;
        }
        const Rows i(row_i);
        const Rows j(row_j);

        Geometry<Pack> g{};
        Bodies b;
        const Pack radius_i = i.packet(p.position, 3);
        const Pack radius_j = j.packet(p.position, 3);
        const Vec3Of<Pack> apart = j.vector(p.position) - i.vector(p.position);
        const Pack distance = square_root(dot(apart, apart));
        // Coincident centres have no direction: any will do, and it must be a number.
        const Mask together = !(Pack{} < distance);
        const Pack inverse = Pack(1.0) / select(together, Pack(1.0), distance);
        g.normal = inverse * apart;
        g.normal.z = select(together, Pack(1.0), g.normal.z);
        g.overlap = larger(Pack{}, radius_i + radius_j - distance);
        b.lever_i = radius_i - Pack(0.5) * g.overlap;
        b.lever_j = radius_j - Pack(0.5) * g.overlap;
        b.material_i = i.packet(p.spin, 3);
        b.material_j = j.packet(p.spin, 3);
        b.inactive = load(inactive);
        if constexpr (contains(Laws::needs, Needs::radii)) {
            g.area_radius = smaller(radius_i, radius_j);
            g.length = radius_i + radius_j;
        }
        if constexpr (contains(Laws::needs, Needs::velocity)) {
            b.velocity_i = i.vector(p.velocity);
            b.velocity_j = j.vector(p.velocity);
        }
        if constexpr (contains(Laws::needs, Needs::spin)) {
            b.spin_i = i.vector(p.spin);
            b.spin_j = j.vector(p.spin);
        }
        if constexpr (contains(Laws::needs, Needs::effective_mass)) {
            b.inverse_mass_i = i.packet(p.velocity, 3);
            b.inverse_mass_j = j.packet(p.velocity, 3);
        }
        complete_geometry<Laws>(b, timestep, g);

        Pack history_in[history_size + 1];
        Pack history_out[history_size + 1];
        if constexpr (history_size > 0) {
            const Rows slots(slot);
            for (int h = 0; h < history_size; ++h) {
                history_in[h] =
                    slots.element(pass.history + static_cast<std::size_t>(h) * pass.history_stride);
            }
        }
        const Load<Pack> load = apply_laws<Laws>(pass.laws, b, g, history_in, history_out);
        if constexpr (history_size > 0) {
            double lanes[width];
            for (int h = 0; h < history_size; ++h) {
                store(history_out[h], lanes);
                double* column = pass.history + static_cast<std::size_t>(h) * pass.history_stride;
                for (Index l = 0; l < valid; ++l) {
                    column[slot[l]] = lanes[l];
                }
            }
        }
        if constexpr (records) {
            keep_records(
                load, g, b, valid, pass.records + static_cast<std::size_t>(first) * record_size);
        }

        const Vec3Of<Pack> force = force_on_j<Laws>(load, g);
        double packets[4 * width];
        store_packets(force, packets);
        for (Index l = 0; l < valid; ++l) {
            subtract_packet(p.force, row_i[l], packets + 4 * l);
            add_packet(p.force, row_j[l], packets + 4 * l);
        }
        if constexpr (contains(Laws::needs, Needs::spin)) {
            // Contact point and force give -r_i n x F on i and -r_j n x F on j.
            const Vec3Of<Pack> turning = cross(g.normal, force);
            double packets_j[4 * width];
            store_packets(b.lever_i * turning, packets);
            store_packets(b.lever_j * turning, packets_j);
            // Lane by lane, so that sums are in the order of the contacts whatever the width.
            for (Index l = 0; l < valid; ++l) {
                subtract_packet(p.torque, row_i[l], packets + 4 * l);
                subtract_packet(p.torque, row_j[l], packets_j + 4 * l);
            }
        }
        for (Index l = 0; l < valid; ++l) {
            pass.active[slot[l]] = 1;
        }
    }
}

/// `width` elements of a column, of which those from `valid` on repeat the last valid one.
inline Pack load_some(const double* column, Index valid) {
    if (valid == width) {
        return load(column);
    }
    double lanes[width];
    for (Index l = 0; l < width; ++l) {
        lanes[l] = column[l < valid ? l : valid - 1];
    }
    return load(lanes);
}

inline void store_some(Pack a, double* column, Index valid) {
    double lanes[width];
    store(a, lanes);
    for (Index l = 0; l < valid; ++l) {
        column[l] = lanes[l];
    }
}

template <class Laws, bool records>
[[gnu::flatten]] void wall_pass(const WallPass& pass) {
    constexpr int history_size = Laws::history_size;
    const ParticleView& p = pass.particles;
    const Pack timestep(pass.laws.timestep);
    for (Index first = 0; first < pass.count; first += width) {
        const Index valid = pass.count - first < width ? pass.count - first : width;
        Index row[width];
        for (Index l = 0; l < width; ++l) {
            row[l] = pass.particle[first + (l < valid ? l : valid - 1)];
        }
        const Rows i(row);
        const auto column = [&](const double* columns, int c) {
            return load_some(columns + static_cast<std::size_t>(c) * pass.stride + first, valid);
        };

        Geometry<Pack> g{};
        Bodies b;
        const Pack radius = i.packet(p.position, 3);
        g.normal = {column(pass.normal, 0), column(pass.normal, 1), column(pass.normal, 2)};
        g.overlap = larger(Pack{}, radius - column(pass.distance, 0));
        b.lever_i = radius - Pack(0.5) * g.overlap;
        b.lever_j = Pack{};  // the wall's spin is already in its velocity at the contact
        b.material_i = i.packet(p.spin, 3);
        b.material_j = Pack(pass.material);
        b.inactive = Pack(1.0) - column(pass.entered, 0);
        if constexpr (contains(Laws::needs, Needs::radii)) {
            g.area_radius = radius;
            g.length = radius;
        }
        if constexpr (contains(Laws::needs, Needs::velocity)) {
            b.velocity_i = i.vector(p.velocity);
            b.velocity_j = {column(pass.wall_velocity, 0),
                            column(pass.wall_velocity, 1),
                            column(pass.wall_velocity, 2)};
        }
        if constexpr (contains(Laws::needs, Needs::spin)) {
            b.spin_i = i.vector(p.spin);
            b.spin_j = column(pass.wall_spin, 0) * g.normal;
        }
        if constexpr (contains(Laws::needs, Needs::effective_mass)) {
            b.inverse_mass_i = i.packet(p.velocity, 3);
            b.inverse_mass_j = Pack{};
        }
        complete_geometry<Laws>(b, timestep, g);

        Pack history_in[history_size + 1];
        Pack history_out[history_size + 1];
        for (int h = 0; h < history_size; ++h) {
            history_in[h] = column(pass.history_in, h);
        }
        const Load<Pack> load = apply_laws<Laws>(pass.laws, b, g, history_in, history_out);
        for (int h = 0; h < history_size; ++h) {
            store_some(history_out[h],
                       pass.history_out + static_cast<std::size_t>(h) * pass.stride + first,
                       valid);
        }
        if constexpr (records) {
            keep_records(
                load, g, b, valid, pass.records + static_cast<std::size_t>(first) * record_size);
        }

        const Vec3Of<Pack> force = force_on_j<Laws>(load, g);
        store_some(force.x, pass.force + first, valid);
        store_some(force.y, pass.force + pass.stride + first, valid);
        store_some(force.z, pass.force + 2 * pass.stride + first, valid);
        double packets[4 * width];
        store_packets(force, packets);
        for (Index l = 0; l < valid; ++l) {
            subtract_packet(p.force, row[l], packets + 4 * l);
        }
        if constexpr (contains(Laws::needs, Needs::spin)) {
            store_packets(b.lever_i * cross(g.normal, force), packets);
            for (Index l = 0; l < valid; ++l) {
                subtract_packet(p.torque, row[l], packets + 4 * l);
            }
        }
    }
}

template <class Pass>
using PassFunction = void (*)(const Pass&);

/// Instances of a pass for every combination of laws, without records first.
template <std::size_t... C>
void run_pair_pass(std::size_t combination,
                   bool records,
                   const PairPass& pass,
                   std::index_sequence<C...>) {
    static constexpr PassFunction<PairPass> table[] = {&pair_pass<LawSetOf<C>, false>...,
                                                       &pair_pass<LawSetOf<C>, true>...};
    table[combination + (records ? sizeof...(C) : 0)](pass);
}

template <std::size_t... C>
void run_wall_pass(std::size_t combination,
                   bool records,
                   const WallPass& pass,
                   std::index_sequence<C...>) {
    static constexpr PassFunction<WallPass> table[] = {&wall_pass<LawSetOf<C>, false>...,
                                                       &wall_pass<LawSetOf<C>, true>...};
    table[combination + (records ? sizeof...(C) : 0)](pass);
}

inline void choose_pair_pass(std::size_t combination, bool records, const PairPass& pass) {
    run_pair_pass(combination, records, pass, std::make_index_sequence<combination_count()>{});
}

inline void choose_wall_pass(std::size_t combination, bool records, const WallPass& pass) {
    run_wall_pass(combination, records, pass, std::make_index_sequence<combination_count()>{});
}

}  // namespace grainbench::GRAINBENCH_ISA
