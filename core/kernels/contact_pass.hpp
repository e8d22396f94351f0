/// Forces of contacts, written once over lanes. Loads, transposes and scatters live here, laws
/// never see memory.
#pragma once

#include "core/contact/law_table.hpp"
#include "core/kernels/kernels.hpp"
#include "core/simd/packets.hpp"
#include "core/simd/places.hpp"

#include <algorithm>

namespace grainbench::GRAINBENCH_ISA {

/// Values of laws for a block of contacts: columns of the table, from `first` on. Where all pairs
/// of materials are alike they are spread over the lanes once per pass.
template <int capacity>
struct BlockValues {
    Pack value[capacity + 1];

    BlockValues(const LawView& view, int first, int count) {
        for (int k = 0; k < count; ++k) {
            value[k] = Pack(view.values[static_cast<std::size_t>(first + k) * view.value_stride]);
        }
    }

    void look_up(const LawView& view, int first, int count, Pack material_i, Pack material_j) {
        const Pack row = material_i * Pack(static_cast<double>(view.material_count)) + material_j;
        for (int k = 0; k < count; ++k) {
            const auto column = static_cast<std::size_t>(first + k) * view.value_stride;
            value[k] = GRAINBENCH_ISA::look_up(view.values + column, row);
        }
    }
};

template <class Laws>
struct LawValues : BlockValues<Laws::most_values> {
    LawValues(const Laws& laws, const LawView& view)
        : BlockValues<Laws::most_values>(view, step_factor_count, laws.value_count()) {}

    void look_up(const Laws& laws, const LawView& view, Pack material_i, Pack material_j) {
        BlockValues<Laws::most_values>::look_up(
            view, step_factor_count, laws.value_count(), material_i, material_j);
    }
};

/// Motion of the bodies of a block of contacts.
struct Bodies {
    Vec3Of<Pack> relative_velocity;  ///< [m/s] of the centre of j, or of the wall, past that of i
    Vec3Of<Pack> spin_i, spin_j;
    Vec3Of<Pack> whole_spin_j;  ///< [rad/s] also where spin_j leaves a part out
    Pack lever_i, lever_j;      ///< [m] from the centres along the normal to where friction acts
    Pack inverse_masses;        ///< [1/kg] the sum of both
    unsigned new_bits;          ///< lanes whose contact did not act in the last step
};

/// Fills the parts of the geometry that the laws need.
template <class Laws>
void complete_geometry(const Laws& laws, const Bodies& b, Pack timestep, Geometry<Pack>& g) {
    g.timestep = timestep;
    if (laws.need(Needs::effective_mass)) {
        g.effective_mass = Pack(1.0) / b.inverse_masses;
    }
    if (laws.need(Needs::velocity)) {
        Vec3Of<Pack> relative = b.relative_velocity;
        g.opening_speed = dot(relative, g.normal);
        if (laws.need(Needs::spin)) {
            // What spins add lies in the contact plane.
            relative -= cross(b.lever_i * b.spin_i + b.lever_j * b.spin_j, g.normal);
            g.sliding_velocity = relative - g.opening_speed * g.normal;
            g.mean_spin = Pack(0.5) * dot(b.spin_i + b.spin_j, g.normal);
        }
    }
    if (laws.need(Needs::relative_spin)) {
        g.relative_spin = b.whole_spin_j - b.spin_i;
    }
    if (laws.need(Needs::entry)) {
        g.entry = Pack(1.0);
        if (b.new_bits != 0) {
            const Pack approach = absolute(g.opening_speed * timestep);
            const Mask partial = (g.overlap < approach) & mask_of(b.new_bits);
            const Pack safe = select(partial, approach, Pack(1.0));
            g.entry = select(partial, g.overlap / safe, Pack(1.0));
        }
    }
}

/// Folds the laws over a block. history_in and history_out hold laws.history_size() packs.
template <class Laws>
Load<Pack> apply_laws(const Laws& laws,
                      const LawValues<Laws>& values,
                      const Geometry<Pack>& g,
                      const Pack* history_in,
                      Pack* history_out) {
    Load<Pack> load;
    load.slipping = Mask::all();
    load.kept = Pack(1.0);
    laws.for_each([&]<class Law>(auto first_value, auto first_history) {
        Law::apply(values_of<Law, Pack>([&](int k) { return values.value[first_value + k]; }),
                   g,
                   history_in + first_history,
                   history_out + first_history,
                   load);
    });
    return load;
}

template <class Laws>
void add_energies(const Laws& laws,
                  const LawValues<Laws>& values,
                  const Geometry<Pack>& g,
                  const Pack* history_in,
                  Load<Pack>& load) {
    laws.for_each([&]<class Law>(auto first_value, auto first_history) {
        add_energies_of<Law>(
            values_of<Law, Pack>([&](int k) { return values.value[first_value + k]; }),
            g,
            history_in + first_history,
            load);
    });
}

/// Force on j: all of it, and its part along the contact plane, which alone turns the bodies. Where
/// no law has such a part, spins keep every bit.
struct ForceOnJ {
    Vec3Of<Pack> whole, tangential;

    template <class Laws>
    ForceOnJ(const Laws& laws, const Load<Pack>& load, const Geometry<Pack>& g)
        : whole((load.normal + load.normal_damping) * g.normal) {
        if (laws.need(Needs::gap)) {
            whole -= load.attraction * g.normal;
        }
        if (laws.need(Needs::spin)) {
            tangential = load.shear + load.shear_damping;
            whole += tangential;
        }
    }
};

/// Writes what a pass asks for of `valid` contacts, the first of which is `first`.
template <class Pass>
void keep_records(const Pass& pass,
                  Index first,
                  const Load<Pack>& load,
                  const Geometry<Pack>& g,
                  const Bodies& b,
                  Index valid) {
    double lanes[width];
    if (pass.stored != nullptr) {
        store(load.stored, lanes);
        std::copy_n(lanes, valid, pass.stored + first);
    }
    if (pass.records == nullptr) {
        return;
    }
    double* const records = pass.records + static_cast<std::size_t>(first) * record_size;
    const Vec3Of<Pack> damping = load.normal_damping * g.normal + load.shear_damping;
    const Pack columns[record_size] = {damping.x,
                                       damping.y,
                                       damping.z,
                                       load.slip_work,
                                       load.stored,
                                       load.normal - load.attraction,
                                       load.shear.x,
                                       load.shear.y,
                                       load.shear.z,
                                       b.lever_i,
                                       b.lever_j,
                                       g.normal.x,
                                       g.normal.y,
                                       g.normal.z,
                                       load.moment.x,
                                       load.moment.y,
                                       load.moment.z};
    for (Index field = 0; field < record_size; ++field) {
        store(columns[field], lanes);
        for (Index l = 0; l < valid; ++l) {
            records[static_cast<std::size_t>(l) * record_size + field] = lanes[l];
        }
    }
}

/// Adds a packet to another, or takes it away.
inline void add_packet(double* to, const double* packet) {
    (Packet(to) + Packet(packet)).store(to);
}

inline void subtract_packet(double* to, const double* packet) {
    (Packet(to) - Packet(packet)).store(to);
}

/// History of the contacts of a block: the first `packets` packets of rows of `row_packets`.
template <int capacity>
struct BlockHistory {
    Pack in[4 * history_packets(capacity) + 1];
    Pack out[4 * history_packets(capacity) + 1];

    void load(const double* rows, const Index* place, Index packets, Index row_packets) {
        for (Index n = 0; n < packets; ++n) {
            const Packets four =
                load_packets(rows, [&](Index l) { return row_packets * place[l] + n; });
            in[4 * n] = four.xyz.x;
            in[4 * n + 1] = four.xyz.y;
            in[4 * n + 2] = four.xyz.z;
            in[4 * n + 3] = four.w;
        }
    }

    void store(
        double* rows, const Index* place, Index valid, Index packets, Index row_packets) const {
        alignas(64) double lanes[4 * width];
        for (Index n = 0; n < packets; ++n) {
            store_packets({out[4 * n], out[4 * n + 1], out[4 * n + 2]}, out[4 * n + 3], lanes);
            for (Index l = 0; l < valid; ++l) {
                const std::size_t row = static_cast<std::size_t>(row_packets) * place[l] + n;
                Packet(lanes + 4 * l).store(rows + 4 * row);
            }
        }
    }
};

/// Places of the contacts of a block; lanes past the end repeat the last contact, and nothing of
/// theirs is stored.
struct Block {
    Index valid;
    unsigned new_bits = 0;
    Index place[width];

    Block(const TouchingContact* touching, Index count)
        : valid(count < width ? count : Index{width}) {
        if (valid == width) {
            new_bits = split_contacts(touching, place);
            return;
        }
        for (Index l = 0; l < width; ++l) {
            const TouchingContact contact = touching[l < valid ? l : valid - 1];
            place[l] = contact.place();
            new_bits |= static_cast<unsigned>(contact.is_new()) << l;
        }
    }
};

/// Particles whose columns a second-level cache of a megabyte holds together with their contacts.
inline constexpr std::size_t cached_particles = 4000;

/// Asks for what contacts read and change of a particle.
inline void fetch_row(const ParticleView& p, std::size_t row) {
    __builtin_prefetch(p.position + 4 * row);
    __builtin_prefetch(p.velocity + 4 * row);
    __builtin_prefetch(p.spin + 4 * row);
    __builtin_prefetch(p.loads + load_row * row, 1);
}

/// Asks for what a later block will read. Its partners lie in a dozen places at once, more than
/// processors follow by themselves.
inline void fetch_ahead(const PairPass& pass, Index first, Index row_packets) {
    for (Index l = 0; l < width; ++l) {
        const Index place = pass.touching[first + l].place();
        fetch_row(pass.particles, pass.j[place]);
        __builtin_prefetch(pass.rows + 4 * std::size_t{row_packets} * place, 1);
    }
}

/// The same of contacts with a wall, whose particles are not neighbours in memory.
inline void fetch_ahead(const WallPass& pass, Index first, Index row_packets) {
    for (Index l = 0; l < width; ++l) {
        const Index place = pass.touching[first + l].place();
        fetch_row(pass.particles, pass.particle[place]);
        __builtin_prefetch(pass.rows + 4 * std::size_t{row_packets} * place, 1);
    }
}

/// \tparam keeps_records few steps do: a pass of their own, so that the others need not hold what
/// only records read.
template <class Laws, bool keeps_records>
GRAINBENCH_FLATTEN void pair_pass(const PairPass& wanted) {
    const PairPass pass = wanted;  // a copy, which no store can change
    const Laws laws(pass.laws.choice);
    const Index packets = history_packets(laws.history_size());
    const ParticleView& p = pass.particles;
    const bool is_far = p.count > cached_particles;
    const Pack timestep(pass.laws.timestep);
    const Pack lever_cut(pass.laws.lever_cut);
    LawValues<Laws> values(laws, pass.laws);
    for (Index first = 0; first < pass.touching_count; first += width) {
        const Block block(pass.touching + first, pass.touching_count - first);
        if (is_far && first + 4 * width < pass.touching_count) {
            fetch_ahead(pass, first + 3 * width, packets);
        }
        Index row_i[width];
        Index row_j[width];
        for (Index l = 0; l < width; ++l) {
            row_i[l] = pass.i[block.place[l]];
            row_j[l] = pass.j[block.place[l]];
        }
        const auto of_i = [&](Index l) { return row_i[l]; };
        const auto of_j = [&](Index l) { return row_j[l]; };

        Geometry<Pack> g{};
        Bodies b;
        const Packets at_i = load_packets(p.position, of_i);
        const Packets at_j = load_packets(p.position, of_j);
        const Vec3Of<Pack> apart = at_j.xyz - at_i.xyz;
        const Pack distance = square_root(dot(apart, apart));
        // Coincident centres have no direction: any will do, and it must be a number.
        const Mask together = !(Pack{} < distance);
        g.normal = (Pack(1.0) / distance) * apart;
        if (any(together)) {
            g.normal = select(together, {Pack{}, Pack{}, Pack(1.0)}, g.normal);
        }
        g.overlap = larger(Pack{}, at_i.w + at_j.w - distance);
        b.lever_i = at_i.w - lever_cut * g.overlap;
        b.lever_j = at_j.w - lever_cut * g.overlap;
        b.new_bits = block.new_bits;
        if (laws.need(Needs::radii)) {
            g.area_radius = smaller(at_i.w, at_j.w);
            g.length = at_i.w + at_j.w;
        }
        if (laws.need(Needs::effective_radius)) {
            g.effective_radius = at_i.w * at_j.w / (at_i.w + at_j.w);
        }
        if (laws.need(Needs::gap)) {
            g.gap = distance - (at_i.w + at_j.w);
            b.lever_i = at_i.w + lever_cut * g.gap;
            b.lever_j = at_j.w + lever_cut * g.gap;
        }
        if (laws.need(Needs::velocity) || laws.need(Needs::effective_mass)) {
            const Packets motion = span(load_rows(p.velocity, of_i), load_rows(p.velocity, of_j));
            b.relative_velocity = motion.xyz;
            b.inverse_masses = motion.w;
        }
        if (laws.need(Needs::spin)) {
            b.spin_i = load_packets(p.spin, of_i).xyz;
            b.spin_j = load_packets(p.spin, of_j).xyz;
            b.whole_spin_j = b.spin_j;
        }
        if (!pass.laws.uniform) {
            values.look_up(
                laws, pass.laws, load_packets(p.spin, of_i).w, load_packets(p.spin, of_j).w);
        }
        complete_geometry(laws, b, timestep, g);

        BlockHistory<Laws::most_history> history;
        history.load(pass.rows, block.place, packets, packets);
        Load<Pack> load = apply_laws(laws, values, g, history.in, history.out);
        history.store(pass.rows, block.place, block.valid, packets, packets);
        if constexpr (keeps_records) {
            add_energies(laws, values, g, history.in, load);
            keep_records(pass, first, load, g, b, block.valid);
        }

        const ForceOnJ force(laws, load, g);
        // Lane by lane, so that sums are in the order of the contacts whatever the width.
        const auto loads_of = [&](Index n) { return p.loads + load_row * n; };
        if (laws.need(Needs::spin)) {
            // Levers and force give -r_i n x F on i, which is taken away, and -r_j n x F on j.
            const Vec3Of<Pack> turning = cross(g.normal, force.tangential);
            Vec3Of<Pack> on_i = b.lever_i * turning;
            Vec3Of<Pack> on_j = -b.lever_j * turning;
            if (laws.need(Needs::relative_spin)) {
                on_i += load.moment;
                on_j += load.moment;
            }
            const TwinPackets from_i(force.whole, on_i);
            const TwinPackets to_j(force.whole, on_j);
            for_each_lane(block.valid, [&]<Index l>() {
                from_i.subtract_from<l>(loads_of(row_i[l]));
                to_j.add_to<l>(loads_of(row_j[l]));
            });
        } else {
            alignas(64) double forces[4 * width];
            store_packets(force.whole, Pack{}, forces);
            for (Index l = 0; l < block.valid; ++l) {
                subtract_packet(loads_of(row_i[l]), forces + 4 * l);
                add_packet(loads_of(row_j[l]), forces + 4 * l);
            }
        }
        if (pass.marks_loaded) {
            for (Index l = 0; l < block.valid; ++l) {
                p.loaded[row_i[l]] = 1;
                p.loaded[row_j[l]] = 1;
            }
        }
    }
}

template <class Laws, bool keeps_records>
GRAINBENCH_FLATTEN void wall_pass(const WallPass& pass) {
    const Laws laws(pass.laws.choice);
    const Index packets = history_packets(laws.history_size());
    const Index row_packets = packets + 1;
    const ParticleView& p = pass.particles;
    const Pack timestep(pass.laws.timestep);
    const Pack lever_cut(pass.laws.lever_cut);
    const auto spread = [](const double(&v)[3]) {
        return Vec3Of<Pack>{Pack(v[0]), Pack(v[1]), Pack(v[2])};
    };
    const Vec3Of<Pack> wall_velocity = spread(pass.velocity);
    const Vec3Of<Pack> wall_spin = spread(pass.spin);
    const Vec3Of<Pack> centre = spread(pass.centre);
    LawValues<Laws> values(laws, pass.laws);
    const bool is_far = p.count > cached_particles;
    for (Index first = 0; first < pass.touching_count; first += width) {
        const Block block(pass.touching + first, pass.touching_count - first);
        if (is_far && first + 4 * width < pass.touching_count) {
            fetch_ahead(pass, first + 3 * width, row_packets);
        }
        Index row[width];
        for (Index l = 0; l < width; ++l) {
            row[l] = pass.particle[block.place[l]];
        }
        const auto of_i = [&](Index l) { return row[l]; };

        Geometry<Pack> g{};
        Bodies b;
        const Packets at_i = load_packets(p.position, of_i);
        const Packets wall = load_packets(
            pass.rows, [&](Index l) { return row_packets * block.place[l] + row_packets - 1; });
        g.normal = wall.xyz;
        g.overlap = larger(Pack{}, at_i.w - wall.w);
        b.lever_i = at_i.w - lever_cut * g.overlap;
        b.lever_j = Pack{};  // the wall's spin is already in its velocity at the contact
        b.new_bits = block.new_bits;
        if (laws.need(Needs::radii)) {
            g.area_radius = at_i.w;
            g.length = at_i.w;
        }
        if (laws.need(Needs::effective_radius)) {
            g.effective_radius = at_i.w;
        }
        if (laws.need(Needs::gap)) {
            g.gap = wall.w - at_i.w;
            b.lever_i = at_i.w + lever_cut * g.gap;
        }
        if (laws.need(Needs::velocity) || laws.need(Needs::effective_mass)) {
            const Packets motion = load_packets(p.velocity, of_i);
            b.inverse_masses = motion.w;
            // There friction acts, as a rule in the middle of the overlap (physics reference 1.1).
            const Vec3Of<Pack> arm = at_i.xyz + b.lever_i * g.normal - centre;
            b.relative_velocity = wall_velocity + cross(wall_spin, arm) - motion.xyz;
        }
        if (laws.need(Needs::spin)) {
            b.spin_i = load_packets(p.spin, of_i).xyz;
            b.spin_j = dot(wall_spin, g.normal) * g.normal;
            b.whole_spin_j = wall_spin;
        }
        if (!pass.laws.uniform) {
            values.look_up(laws, pass.laws, load_packets(p.spin, of_i).w, Pack(pass.material));
        }
        complete_geometry(laws, b, timestep, g);

        BlockHistory<Laws::most_history> history;
        history.load(pass.rows, block.place, packets, row_packets);
        Load<Pack> load = apply_laws(laws, values, g, history.in, history.out);
        history.store(pass.rows, block.place, block.valid, packets, row_packets);
        if constexpr (keeps_records) {
            add_energies(laws, values, g, history.in, load);
            keep_records(pass, first, load, g, b, block.valid);
        }

        const ForceOnJ force(laws, load, g);
        const auto loads_of = [&](Index n) { return p.loads + load_row * n; };
        alignas(64) double forces[4 * width];
        store_packets(force.whole, Pack{}, forces);
        for (Index l = 0; l < block.valid; ++l) {
            Packet(forces + 4 * l).store(pass.force + 4 * static_cast<std::size_t>(first + l));
            p.loaded[row[l]] = 1;
        }
        if (laws.need(Needs::spin)) {
            Vec3Of<Pack> on_i = b.lever_i * cross(g.normal, force.tangential);
            if (laws.need(Needs::relative_spin)) {
                on_i += load.moment;
            }
            const TwinPackets from_i(force.whole, on_i);
            for_each_lane(block.valid,
                          [&]<Index l>() { from_i.subtract_from<l>(loads_of(row[l])); });
        } else {
            for (Index l = 0; l < block.valid; ++l) {
                subtract_packet(loads_of(row[l]), forces + 4 * l);
            }
        }
    }
}

}  // namespace grainbench::GRAINBENCH_ISA
