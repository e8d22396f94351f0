/// Kick and drift of particles, and how far they have come.
#pragma once

#include "core/kernels/kernels.hpp"
#include "core/simd/packets.hpp"

#include <cstring>

namespace grainbench::GRAINBENCH_ISA {

// A call per particle would cost a quarter of these passes, and g++ inlines only what has one
// caller.

/// v += F/m kick, omega += T/I kick; force and torque are taken away. Returns v.
/// \tparam turns whether there may be torques
template <bool turns>
[[gnu::always_inline]] inline Packet kick_by_loads(const ParticleView& p,
                                                   std::size_t row,
                                                   const Packet& kick) {
    double* const loads = p.loads + load_row * row;
    const Packet zero(0.0);
    const Packet velocity(p.velocity + 4 * row);
    const Packet kicked =
        velocity + (Packet(loads + force_packet) * velocity.fourth() * kick).without_fourth();
    zero.store(loads + force_packet);
    if constexpr (turns) {
        double* const spin = p.spin + 4 * row;
        const Packet torque(loads + torque_packet);
        (Packet(spin) + (torque * torque.fourth() * kick).without_fourth()).store(spin);
        with_fourth(zero, torque).store(loads + torque_packet);
    }
    return kicked;
}

/// Bits of eight flags, each 0 or 1, the first of them lowest.
inline std::uint64_t bits_of_flags(const std::uint8_t* flags) {
    std::uint64_t all = 0;
    std::memcpy(&all, flags, 8);
    constexpr std::uint64_t to_top_byte = 0x0102040810204080;  // flag n to bit 56 + n
    return all * to_top_byte >> 56;
}

/// Calls act(row) for each loaded particle of [begin, end) and marks it as no longer loaded. Flags
/// are taken 64 at a time: where few are set, a branch for eight of them would be a guess.
template <class Act>
void for_each_loaded(const ParticleView& p, std::size_t begin, std::size_t end, const Act& act) {
    for (std::size_t first = begin; first < end; first += 64) {
        const std::size_t left = (end - first + 7) / 8 * 8;
        const std::size_t rows = left < 64 ? left : 64;
        std::uint64_t bits = 0;
        for (std::size_t k = 0; k < rows; k += 8) {
            bits |= bits_of_flags(p.loaded + first + k) << k;
        }
        std::memset(p.loaded + first, 0, rows);
        for (; bits != 0; bits &= bits - 1) {
            act(first + static_cast<std::size_t>(__builtin_ctzll(bits)));
        }
    }
}

/// Of one row as a Packet, or of two as a PacketPair.
template <class Rows, class Of>
[[gnu::always_inline]] inline Rows rows_of(std::size_t row, const Of& of) {
    if constexpr (std::is_same_v<Rows, Packet>) {
        return of(row);
    } else {
        return {of(row), of(row + 1)};
    }
}

/// The same packet for each row.
template <class Rows>
Rows alike(const Packet& packet) {
    return rows_of<Rows>(0, [&](std::size_t) { return packet; });
}

/// Moves the particles of a pass by velocities, and measures them. Two running sums whatever the
/// vector length keep the bits the same on every instruction set.
/// \param velocity_of new ones, `velocity_of.template operator()<Rows>(row)`
template <class VelocityOf>
[[gnu::always_inline]] inline void drift(MotionPass& pass, const VelocityOf& velocity_of) {
    const ParticleView p = pass.particles;  // a copy, which no store can change
    const std::size_t last = pass.last;
    alignas(32) const double drift_components[4] = {pass.drift, pass.drift, pass.drift, 0.0};
    alignas(32) double components[4];
    std::memcpy(components, pass.frame, sizeof components);
    const Packet way(drift_components);
    const Packet frame(components);

    /// Returns the square of the velocity in the frame, by component.
    const auto advance = [&]<class Rows>(std::size_t row, Rows & sum)
        __attribute__((always_inline)) {
        const Rows velocity = velocity_of.template operator()<Rows>(row);
        velocity.store(p.velocity + 4 * row);
        double* const position = p.position + 4 * row;
        (Rows(position) + velocity * alike<Rows>(way)).store(position);
        sum = sum + velocity;
        const Rows relative = (velocity - alike<Rows>(frame)).without_fourth();
        return relative * relative;
    };

    const Packet zero(0.0);
    PacketPair sum_of_two(zero, zero);
    PacketPair largest_of_two(zero, zero);
    std::size_t row = pass.first;
    for (; row + 3 < last; row += 4) {
        const PacketPair square = advance(row, sum_of_two);
        largest_of_two = larger(sums(square, advance(row + 2, sum_of_two)), largest_of_two);
    }
    Packet sum[2] = {sum_of_two.low(), sum_of_two.high()};
    Packet largest = larger(largest_of_two.low(), largest_of_two.high());
    for (; row < last; ++row) {
        largest = larger(sums(advance(row, sum[row % 2]), zero), largest);
    }
    largest.store(components);
    pass.fastest_square = components[0] < components[1] ? components[1] : components[0];
    (sum[0] + sum[1]).store(components);
    std::memcpy(pass.velocity_sum, components, sizeof components);
}

inline Packet gravity_of(const MotionPass& pass) {
    alignas(32) double components[4];
    std::memcpy(components, pass.gravity, sizeof components);
    return Packet(components);
}

/// Forces and gravity kick one after the other, so that particles without loads may skip the first.
template <bool turns>
void move(MotionPass& pass) {
    const ParticleView& p = pass.particles;
    const Packet kick(pass.kick);
    const Packet fall = gravity_of(pass) * kick;
    if (pass.few_are_loaded) {
        for_each_loaded(p, pass.first, pass.last, [&](std::size_t row) {
            kick_by_loads<turns>(p, row, kick).store(p.velocity + 4 * row);
        });
        drift(
            pass, [&]<class Rows>(std::size_t row) __attribute__((always_inline)) {
                return Rows(p.velocity + 4 * row) + alike<Rows>(fall);
            });
    } else {
        std::memset(p.loaded + pass.first, 0, pass.last - pass.first);
        drift(
            pass, [&]<class Rows>(std::size_t row) __attribute__((always_inline)) {
                return rows_of<Rows>(
                    row, [&](std::size_t each) __attribute__((always_inline)) {
                        return kick_by_loads<turns>(p, each, kick) + fall;
                    });
            });
    }
}

/// As move(), under local damping (core/body/laws/local_damping.hpp, (1)).
inline void move_damped(MotionPass& pass) {
    const ParticleView& p = pass.particles;
    const Packet kick(pass.kick);
    const Packet zero(0.0);
    const Packet gravity = gravity_of(pass);
    const Packet coefficient(pass.local_damping);
    const auto kicked = [&](const Packet& velocity, const Packet& acceleration) {
        const Packet lost = opposed(coefficient * absolute(acceleration), velocity);
        return velocity + ((acceleration + lost) * kick).without_fourth();
    };
    std::memset(p.loaded + pass.first, 0, pass.last - pass.first);
    const auto moved = [&](std::size_t row) __attribute__((always_inline)) {
        double* const loads = p.loads + load_row * row;
        double* const spin = p.spin + 4 * row;
        const Packet torque(loads + torque_packet);
        kicked(Packet(spin), torque * torque.fourth()).store(spin);
        const Packet velocity(p.velocity + 4 * row);
        const Packet result =
            kicked(velocity, Packet(loads + force_packet) * velocity.fourth() + gravity);
        zero.store(loads + force_packet);
        with_fourth(zero, torque).store(loads + torque_packet);
        return result;
    };
    drift(pass, [&]<class Rows>(std::size_t row) { return rows_of<Rows>(row, moved); });
}

GRAINBENCH_FLATTEN inline void measure_travel(TravelPass& pass) {
    const Vec3Of<Pack> frame{Pack(pass.frame[0]), Pack(pass.frame[1]), Pack(pass.frame[2])};
    const Pack smallest_square(pass.smallest_radius * pass.smallest_radius);
    Pack largest;
    for (std::size_t first = 0; first < pass.padded_count; first += width) {
        const auto row = [&](Index l) { return first + l; };
        const Packets both = span(load_rows(pass.reference, row), load_rows(pass.position, row));
        const Pack radius = Pack(0.5) * both.w;
        const Vec3Of<Pack> way = both.xyz - frame;
        Pack square = dot(way, way);
        if (pass.by_radius) {
            square = square * smallest_square / (radius * radius);
        }
        // Padding has no radius.
        largest = larger(largest, select(Pack{} < radius, square, Pack{}));
    }
    double lanes[width];
    store(largest, lanes);
    pass.largest_square = 0.0;
    for (const double lane : lanes) {
        pass.largest_square = pass.largest_square < lane ? lane : pass.largest_square;
    }
}

}  // namespace grainbench::GRAINBENCH_ISA
