/// Small frames whose numbers tell each other apart and survive single precision.
#pragma once

#include "core/frame.hpp"

#include "io/vtk/frame_writer.hpp"

namespace grainbench {

inline ParticleFrame some_particles(std::size_t count, double time = 0.1) {
    ParticleFrame frame;
    frame.time = time;
    frame.cycle = 1234567890123;
    for (std::size_t k = 0; k < count; ++k) {
        const auto n = static_cast<std::int32_t>(k);
        const double x = 0.25 * n;
        frame.id.push_back((std::int64_t{1} << 53) + 1 + n);  // no double holds this id
        frame.position.push_back({x, x + 1.0, x - 1.0});
        frame.radius.push_back(0.5 + x);
        frame.species.push_back(n % 2);
        frame.group.push_back(n % 3);
        frame.layer.push_back(n + 1);
        frame.current_layer.push_back(n + 2);
        frame.velocity.push_back({x, 2.0, -x});
        frame.angular_velocity.push_back({3.0, x, -x});
        frame.force.push_back({-x, x, 4.0});
        frame.contacts.push_back(n + 5);
    }
    return frame;
}

inline WallFrame some_walls(double time = 0.1) {
    WallFrame frame{.time = time, .cycle = 7, .walls = {}};
    frame.walls.push_back({.name = "floor \xC3\xBC <&\">",
                           .points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                           .polygons = {{0, 1, 2, 3}},
                           .velocity = {0, 0, 0.5},
                           .force = {0, 0, -2}});
    frame.walls.push_back({.name = "roof",
                           .points = {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
                           .polygons = {{0, 1, 2}, {0, 2, 3}},
                           .velocity = {1, 0, 0},
                           .force = {0.5, 0, 0}});
    return frame;
}

inline ContactFrame some_contacts(std::size_t count, double time = 0.1) {
    ContactFrame frame{.time = time,
                       .cycle = 7,
                       .i_id = {},
                       .j_id = {},
                       .wall = {},
                       .i_position = {},
                       .j_position = {},
                       .overlap = {},
                       .force_normal = {},
                       .force_tangential = {},
                       .point = {},
                       .branch = {},
                       .force = {},
                       .i_species = {},
                       .j_species = {}};
    for (std::size_t k = 0; k < count; ++k) {
        const double x = 0.25 * static_cast<double>(k);
        frame.i_id.push_back(static_cast<std::int64_t>(k) + 1);
        frame.j_id.push_back(k % 2 == 0 ? 0 : static_cast<std::int64_t>(k) + 2);
        frame.wall.push_back(k % 2 == 0 ? 1 : 0);
        frame.i_position.push_back({x, 0, 0});
        frame.j_position.push_back({x, 1, 0});
        frame.overlap.push_back(x);
        frame.force_normal.push_back(2 * x);
        frame.force_tangential.push_back(3 * x);
        frame.point.push_back({x, 0.5, 0});
        frame.branch.push_back({0, 1, 0});
        frame.force.push_back({x, 2 * x, -x});
        frame.i_species.push_back(0);
        frame.j_species.push_back(k % 2 == 0 ? -1 : 1);
    }
    return frame;
}

/// A grid of `counts` cells; empty columns if one of them is 0.
inline FieldFrame some_fields(std::array<Index, 3> counts, double time = 0.1) {
    FieldFrame frame{.time = time,
                     .cycle = 7,
                     .low = {-1, 2, 0.5},
                     .spacing = {0.5, 0.25, 2},
                     .counts = counts,
                     .density = {},
                     .solid_fraction = {},
                     .velocity = {},
                     .granular_temperature = {},
                     .pressure = {},
                     .contact_stress = {},
                     .kinetic_stress = {}};
    for (Index k = 0; k < counts[0] * counts[1] * counts[2]; ++k) {
        const double x = 0.25 * k;
        frame.density.push_back(x);
        frame.solid_fraction.push_back(2 * x);
        frame.velocity.push_back({x, 1, -x});
        frame.granular_temperature.push_back(3 * x);
        frame.pressure.push_back(4 * x);
        frame.contact_stress.push_back({x, 1, 2, 3, 4, 5, 6, 7, 8});
        frame.kinetic_stress.push_back({-x, 0, 0, 0, 0, 0, 0, 0, 0});
    }
    return frame;
}

/// Particles 1, 2, ... at each time; none of them if `particles` is 0.
inline io::TraceTable some_traces(std::int64_t particles, const std::vector<double>& times) {
    io::TraceTable traces;
    for (const double time : times) {
        for (std::int64_t id = 1; id <= particles; ++id) {
            const TracePoint point{
                .id = id, .position = {time, static_cast<double>(id), 0}, .velocity = {0, 0, time}};
            traces.append(time, {&point, 1});
        }
    }
    return traces;
}

inline io::Provenance some_provenance() {
    return {.program = "grainbench 1.2.3",
            .scene_title = "a title with \xC3\xBC & <tags>",
            .scene_hash = "0123456789abcdef",
            .seed = 10001,
            .species_names = {"glass", "steel"}};
}

}  // namespace grainbench
