/// Kick and drift of particles, and how far they have come.
#pragma once

#include "core/kernels/kernels.hpp"
#include "core/simd/lanes.hpp"

#include <cstring>

namespace grainbench::GRAINBENCH_ISA {

// A call per particle would cost a quarter of these passes, and g++ inlines only what has one
// caller.

/// v += F/m kick, omega += T/I kick; force and torque are taken away.
/// \tparam turns whether there may be torques
template <bool turns>
[[gnu::always_inline]] inline Packet kick_by_loads(const ParticleView& p,
                                                   std::size_t row,
                                                   const Packet& kick) {
    double* const motion = p.motion + motion_row * row;
    const Packet zero(0.0);
    const Packet velocity(motion + velocity_packet);
    const Packet kicked =
        velocity + with_fourth(Packet(motion + force_packet) * velocity.fourth() * kick, zero);
    zero.store(motion + force_packet);
    if constexpr (turns) {
        const Packet torque(motion + torque_packet);
        (Packet(motion + spin_packet) + with_fourth(torque * torque.fourth() * kick, zero))
            .store(motion + spin_packet);
        with_fourth(zero, torque).store(motion + torque_packet);
    }
    return kicked;
}

/// Calls act(row) for each loaded particle of [begin, end) and marks it as no longer loaded.
template <class Act>
void for_each_loaded(const ParticleView& p, std::size_t begin, std::size_t end, const Act& act) {
    for (std::size_t first = begin; first < end; first += 8) {
        std::uint64_t flags = 0;
        std::memcpy(&flags, p.loaded + first, 8);
        if (flags == 0) {
            continue;
        }
        for (; flags != 0; flags &= flags - 1) {
            act(first + static_cast<std::size_t>(__builtin_ctzll(flags)) / 8);
        }
        std::memset(p.loaded + first, 0, 8);
    }
}

/// Moves the particles of a pass by velocities velocity_of(row), and measures them. Two running
/// sums whatever the vector length keep the bits the same on every instruction set.
template <class VelocityOf>
[[gnu::always_inline]] inline void drift(MotionPass& pass, const VelocityOf& velocity_of) {
    const ParticleView& p = pass.particles;
    const Packet zero(0.0);
    alignas(32) const double drift_components[4] = {pass.drift, pass.drift, pass.drift, 0.0};
    alignas(32) double components[4];
    std::memcpy(components, pass.frame, sizeof components);
    const Packet way(drift_components);
    const Packet frame(components);
    Packet sum[2] = {zero, zero};
    Packet largest = zero;
    /// Returns the square of the velocity in the frame, by component.
    const auto advance = [&](std::size_t row, std::size_t k) __attribute__((always_inline)) {
        const Packet velocity = velocity_of(row);
        velocity.store(p.motion + motion_row * row + velocity_packet);
        double* const position = p.position + 4 * row;
        (Packet(position) + velocity * way).store(position);
        sum[k] = sum[k] + velocity;
        const Packet relative = with_fourth(velocity - frame, zero);
        return relative * relative;
    };
    std::size_t row = pass.first;
    for (; row + 1 < pass.last; row += 2) {
        const Packet square = advance(row, 0);
        largest = larger(sums(square, advance(row + 1, 1)), largest);
    }
    if (row < pass.last) {
        largest = larger(sums(advance(row, 0), zero), largest);
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
            kick_by_loads<turns>(p, row, kick).store(p.motion + motion_row * row + velocity_packet);
        });
        drift(pass, [&](std::size_t row) {
            return Packet(p.motion + motion_row * row + velocity_packet) + fall;
        });
    } else {
        std::memset(p.loaded + pass.first, 0, pass.last - pass.first);
        drift(
            pass, [&](std::size_t row) __attribute__((always_inline)) {
                return kick_by_loads<turns>(p, row, kick) + fall;
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
        return velocity + with_fourth((acceleration + lost) * kick, zero);
    };
    std::memset(p.loaded + pass.first, 0, pass.last - pass.first);
    drift(pass, [&](std::size_t row) {
        double* const motion = p.motion + motion_row * row;
        const Packet torque(motion + torque_packet);
        kicked(Packet(motion + spin_packet), torque * torque.fourth()).store(motion + spin_packet);
        const Packet velocity(motion + velocity_packet);
        const Packet result =
            kicked(velocity, Packet(motion + force_packet) * velocity.fourth() + gravity);
        zero.store(motion + force_packet);
        with_fourth(zero, torque).store(motion + torque_packet);
        return result;
    });
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
