#include "tests/unit/render/small_run.hpp"

#include "io/atomic_file.hpp"
#include "io/text.hpp"
#include "io/vtk/frame_writer.hpp"
#include "io/vtk/pvd.hpp"

#include <cmath>
#include <string>
#include <vector>

namespace grainbench {
namespace {

/// A lattice of 4 by 4 and as many layers as it takes; every fifth sphere is large. It sinks and
/// turns a little with time.
ParticleFrame particles_at(double time, std::size_t count, int realisation) {
    ParticleFrame frame;
    frame.time = time;
    for (std::size_t k = 0; k < count; ++k) {
        const auto n = static_cast<std::int32_t>(k);
        const bool is_large = (n + realisation) % 5 == 0;
        const std::int32_t level = n / 16;
        frame.id.push_back(n + 1);
        frame.position.push_back({0.012 * (n % 4) - 0.018 + 0.01 * time,
                                  0.012 * (n / 4 % 4) - 0.018,
                                  0.012 * level + 0.006 - 0.02 * time * level});
        frame.radius.push_back(is_large ? 0.006 : 0.004);
        frame.species.push_back(is_large ? 1 : 0);
        frame.group.push_back(is_large ? 2 : 1);
        frame.layer.push_back(4 - level);
        frame.current_layer.push_back(1 + (level + n) % 4);
        frame.velocity.push_back({0.01, 0.0, -0.02 * level});
        frame.angular_velocity.push_back({0.0, 1.0 * n, 0.0});
        frame.force.push_back({0.0, 0.0, 0.001 * n});
        frame.contacts.push_back(n % 7);
    }
    return frame;
}

WallFrame walls_at(double time) {
    const double a = 0.026;
    const double h = 0.06;
    const std::vector<Vec3> corners{{-a, -a, 0},
                                    {a, -a, 0},
                                    {a, a, 0},
                                    {-a, a, 0},
                                    {-a, -a, h},
                                    {a, -a, h},
                                    {a, a, h},
                                    {-a, a, h}};
    WallFrame frame{.time = time, .cycle = 0, .walls = {}};
    frame.walls.push_back({.name = "floor",
                           .points = {corners[0], corners[1], corners[2], corners[3]},
                           .polygons = {{0, 3, 2, 1}},
                           .velocity = {},
                           .force = {}});
    frame.walls.push_back({.name = "sides",
                           .points = corners,
                           .polygons = {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}},
                           .velocity = {},
                           .force = {}});
    return frame;
}

io::TraceTable some_paths() {
    io::TraceTable traces;
    for (int k = 0; k <= 40; ++k) {
        const double time = 0.005 * k;
        for (std::int64_t id = 1; id <= 3; ++id) {
            const double angle = 25.0 * time + 2.0 * static_cast<double>(id);
            const TracePoint point{
                .id = id,
                .position = {0.02 * std::cos(angle), 0.02 * std::sin(angle), 0.01 + 0.2 * time},
                .velocity = {0.1 * time, 0.0, 0.2}};
            traces.append(time, {&point, 1});
        }
    }
    return traces;
}

}  // namespace

void write_small_run(const std::filesystem::path& folder, std::size_t particles) {
    io::make_folder(folder);
    io::write_file(folder / "scene.json",
                   R"({"groups": [{"name": "fine"}, {"name": "coarse"}], "layers": {}})");
    for (int realisation = 1; realisation <= 2; ++realisation) {
        const auto place = folder / ("realisation-" + std::to_string(realisation));
        const io::Provenance provenance{.program = "grainbench 1.2.3",
                                        .scene_title = "small run",
                                        .scene_hash = "0123456789abcdef",
                                        .seed = 7 + realisation,
                                        .species_names = {"small", "large"}};
        io::make_folder(place);
        std::vector<io::PvdEntry> particle_files;
        std::vector<io::PvdEntry> wall_files;
        for (std::size_t k = 0; k < 3; ++k) {
            const double time = 0.1 * static_cast<double>(k);
            particle_files.push_back({time, "particles_" + io::padded(k) + ".vtu"});
            wall_files.push_back({time, "walls_" + io::padded(k) + ".vtp"});
            io::write_particles(place / particle_files.back().file,
                                particles_at(time, particles, realisation),
                                provenance);
            io::write_walls(place / wall_files.back().file, walls_at(time), provenance);
        }
        io::write_pvd(place / "particles.pvd", particle_files);
        io::write_pvd(place / "walls.pvd", wall_files);
        io::write_traces(place / "traces.vtp", some_paths(), provenance);
    }
}

}  // namespace grainbench
