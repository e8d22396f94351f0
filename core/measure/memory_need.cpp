#include "core/measure/memory_need.hpp"

#include "core/error.hpp"
#include "core/walls/faceted.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <sstream>
#include <string_view>

namespace grainbench {

namespace {

/// [bytes] State, contacts and lists of a particle in a packing, and of each wall for a particle:
/// columns and lists take 1000 in a dense bed with friction, frames and checkpoints in the making
/// as much again, and work space the rest. Of a facet: its geometry, planes and place in the tree.
constexpr double bytes_per_particle = 2500.0;
constexpr double bytes_per_particle_and_wall = 100.0;
constexpr double bytes_per_facet = 700.0;

/// [bytes] Fields of a cell, and as much again for its file in the making. Fields are not kept.
constexpr double bytes_per_cell = 400.0;

/// Part of its box that a random insertion can fill with spheres: no packing is denser.
constexpr double densest = 0.7405;

double most_in_box(const Scene& scene, const RandomInsertion& random) {
    double most = std::min(static_cast<double>(random.count), static_cast<double>(random.tries));
    for (const Species& species : scene.particles.species) {
        if (species.name == random.species) {
            const Vec3 edge = random.box.high - random.box.low;
            const double r = species.radius;
            most =
                std::min(most, densest * edge.x * edge.y * edge.z / (4.0 / 3.0 * pi * r * r * r));
        }
    }
    return std::max(most, 0.0);
}

double count_of(const Scene& scene, const Insertion& insertion) {
    return std::visit(
        Overloaded{[&](const RandomInsertion& i) { return most_in_box(scene, i); },
                   [](const LatticeInsertion& i) {
                       double count = 1.0;
                       for (const std::int64_t along : i.counts) {
                           count *= static_cast<double>(along);
                       }
                       return count;
                   },
                   [](const ListInsertion& i) { return static_cast<double>(i.particles.size()); },
                   [](const FileInsertion& i) { return static_cast<double>(i.imported.size()); }},
        insertion);
}

double facets_of(const WallShape& shape) {
    if (const auto* cylinder = std::get_if<FacetedCylinder>(&shape)) {
        return 4.0 * pi / std::asin(std::min(0.5 * cylinder->resolution, 1.0));
    }
    const auto* mesh = std::get_if<MeshFile>(&shape);
    return mesh != nullptr ? static_cast<double>(mesh->triangles.size()) : 0.0;
}

std::string text_of(double bytes) {
    char text[40];
    std::snprintf(text, sizeof text, "%.3g bytes", bytes);
    return text;
}

}  // namespace

MemoryNeed estimate_memory(const Scene& scene) {
    MemoryNeed need;
    double largest = 0.0;
    const auto copies = static_cast<double>(scene.realisations.count);
    const auto add = [&](double bytes, const std::string& where) {
        need.bytes += bytes;
        if (bytes > largest) {
            largest = bytes;
            need.largest_where = where;
        }
    };
    const double per_particle =
        bytes_per_particle + bytes_per_particle_and_wall * static_cast<double>(scene.walls.size());
    for (std::size_t k = 0; k < scene.particles.insertion.size(); ++k) {
        add(copies * per_particle * count_of(scene, scene.particles.insertion[k]),
            "/particles/insertion/" + std::to_string(k));
    }
    double duration = 0.0;
    for (const Stage& stage : scene.stages) {
        duration += stage.duration;
    }
    for (std::size_t s = 0; s < scene.particles.sources.size(); ++s) {
        const Source& source = scene.particles.sources[s];
        const double length = std::min(duration, source.end.value_or(duration)) - source.start;
        const double due = std::max(0.0, source.rate * length + 1.0);
        const double most = source.count ? static_cast<double>(*source.count) : due;
        add(copies * per_particle * std::min(due, most), "/particles/sources/" + std::to_string(s));
    }
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        add(copies * bytes_per_facet * facets_of(scene.walls[w].shape),
            "/walls/" + std::to_string(w) + "/shape");
    }
    if (const auto& fields = scene.observables.coarse_graining) {
        double cells = 1.0;
        for (const std::int64_t along : fields->counts) {
            cells *= static_cast<double>(along);
        }
        add(bytes_per_cell * cells, "/observables/coarse_graining/counts");
    }
    return need;
}

double available_memory() {
    double least = std::numeric_limits<double>::infinity();
    std::string word;
    for (std::ifstream all("/proc/meminfo"); all >> word;) {
        double kibibytes = 0.0;
        if (word == "MemTotal:" && all >> kibibytes) {
            least = std::min(least, 1024.0 * kibibytes);
        }
    }
    std::string line;
    for (std::ifstream limits("/proc/self/limits"); std::getline(limits, line);) {
        constexpr std::string_view name = "Max address space";
        double bytes = 0.0;
        if (line.starts_with(name) && std::istringstream(line.substr(name.size())) >> bytes) {
            least = std::min(least, bytes);
        }
    }
    double of_group = 0.0;
    if (std::ifstream("/sys/fs/cgroup/memory.max") >> of_group) {
        least = std::min(least, of_group);
    }
    return least;
}

void require_memory(const Scene& scene) {
    const MemoryNeed need = estimate_memory(scene);
    const double available = available_memory();
    if (need.bytes <= available) {
        return;
    }
    throw_bad_input({.what = "the scene needs about " + text_of(need.bytes) +
                             " of memory; this machine has " + text_of(available),
                     .where = need.largest_where,
                     .likely_cause =
                         "a count, or the number of facets, far beyond what was meant; or too many "
                         "realisations for this machine",
                     .next_step = "make it smaller; /realisations/count multiplies it"});
}

}  // namespace grainbench
