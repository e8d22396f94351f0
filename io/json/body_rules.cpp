#include "core/scene.hpp"

#include "io/json/scene_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace grainbench::io {

namespace {

void add(Problems& problems,
         std::string pointer,
         std::string what,
         std::string likely_cause,
         std::string next_step) {
    problems.add(
        {std::move(pointer), std::move(what), std::move(likely_cause), std::move(next_step)});
}

void check_lattice(const LatticeInsertion& lattice, const std::string& at, Problems& problems) {
    if (lattice.counts.size() != 3) {
        add(problems,
            at + "/counts",
            fmt::format("{} numbers; expected 3", lattice.counts.size()),
            "one number for each axis is needed",
            "give [along x, along y, along z]");
        return;
    }
    const Vec3& s = lattice.spacing;
    const double spacing[3] = {s.x, s.y, s.z};
    double total = 1.0;
    for (std::size_t k = 0; k < 3; ++k) {
        total *= static_cast<double>(lattice.counts[k]);
        if (lattice.counts[k] > 1 && spacing[k] == 0.0) {
            add(problems,
                fmt::format("{}/spacing/{}", at, k),
                fmt::format("0 m between {} spheres", lattice.counts[k]),
                "all spheres would lie in one place",
                "give a spacing of at least the diameter");
        }
    }
    if (total > static_cast<double>(std::numeric_limits<Index>::max())) {
        add(problems,
            at + "/counts",
            fmt::format("{:g} spheres", total),
            "more than a simulation can number",
            "give smaller counts");
    }
}

/// The box must hold a sphere of the species.
void check_room(const Particles& particles,
                const std::string& name,
                const Box& box,
                const std::string& at,
                Problems& problems) {
    for (const Species& species : particles.species) {
        const Vec3 edge = box.high - box.low;
        const double smallest = std::min({edge.x, edge.y, edge.z});
        if (species.name == name && smallest > 0.0 && smallest < 2.0 * species.radius) {
            add(problems,
                at,
                fmt::format("the box is {} m thin, the spheres are {} m wide",
                            smallest,
                            2.0 * species.radius),
                "the box bounds the surfaces of the spheres, not their centres",
                "enlarge the box or choose a smaller species");
        }
    }
}

void check_random(const Scene& scene,
                  const RandomInsertion& random,
                  const std::string& at,
                  Problems& problems) {
    check_box(random.box.low, random.box.high, at + "/box", problems);
    if (random.count > 0) {
        check_room(scene.particles, random.species, random.box, at + "/box", problems);
    }
    if (!random.inside) {
        return;
    }
    check_known(*random.inside, names_of(scene.walls), "wall", at + "/inside", problems);
    for (const Wall& wall : scene.walls) {
        if (wall.name == *random.inside && (std::holds_alternative<Plane>(wall.shape) ||
                                            std::holds_alternative<Disc>(wall.shape))) {
            add(problems,
                at + "/inside",
                fmt::format("the wall '{}' encloses nothing", wall.name),
                "a plane or a disc has no inside",
                "name a closed wall, or leave 'inside' out");
        }
    }
}

void check_insertion(const Scene& scene,
                     const Insertion& insertion,
                     const std::string& at,
                     Problems& problems) {
    const auto species = names_of(scene.particles.species);
    std::visit(
        Overloaded{[&](const RandomInsertion& random) {
                       check_known(random.species, species, "species", at + "/species", problems);
                       check_random(scene, random, at, problems);
                   },
                   [&](const LatticeInsertion& lattice) {
                       check_known(lattice.species, species, "species", at + "/species", problems);
                       check_lattice(lattice, at, problems);
                   },
                   [&](const ListInsertion& list) {
                       for (std::size_t i = 0; i < list.particles.size(); ++i) {
                           check_known(list.particles[i].species,
                                       species,
                                       "species",
                                       fmt::format("{}/particles/{}/species", at, i),
                                       problems);
                       }
                   },
                   [&](const FileInsertion& file) {
                       check_known(file.species, species, "species", at + "/species", problems);
                       for (const FileInsertion::Row& row : file.imported) {
                           check_known(row.species, species, "species", at + "/path", problems);
                       }
                   }},
        insertion);
}

void check_traffic(const Particles& particles, Problems& problems) {
    check_unique_names(names_of(particles.sources), "/particles/sources", problems);
    check_unique_names(names_of(particles.sinks), "/particles/sinks", problems);
    for (std::size_t i = 0; i < particles.sources.size(); ++i) {
        const Source& source = particles.sources[i];
        const std::string at = fmt::format("/particles/sources/{}", i);
        check_known(
            source.species, names_of(particles.species), "species", at + "/species", problems);
        check_box(source.box.low, source.box.high, at + "/box", problems);
        check_room(particles, source.species, source.box, at + "/box", problems);
        if (source.end && !(*source.end > source.start)) {
            add(problems,
                at + "/end",
                fmt::format("{} s is not after the start at {} s", *source.end, source.start),
                "the source would never act",
                "give an end after the start, or leave it out");
        }
    }
    for (std::size_t i = 0; i < particles.sinks.size(); ++i) {
        const Sink& sink = particles.sinks[i];
        const std::string at = fmt::format("/particles/sinks/{}", i);
        if (sink.box) {
            check_box(sink.box->low, sink.box->high, at + "/box", problems);
        }
        if (!(sink.low < sink.high)) {
            add(problems,
                at + "/high",
                fmt::format("{} m is not above 'low', {} m", sink.high, sink.low),
                "the ends are swapped",
                "give low < high");
        }
        if (!sink.box && sink.low == -1e300 && sink.high == 1e300) {
            add(problems,
                at,
                "a sink without bounds",
                "it would delete every sphere",
                "give 'high' to delete below a height, 'low', or a 'box'");
        }
        for (const Source& source : particles.sources) {
            if (source.name == sink.name) {
                add(problems,
                    at + "/name",
                    fmt::format("the name '{}' is taken by a source", sink.name),
                    "their columns of the history would have one name",
                    "give each a name of its own");
            }
        }
    }
}

void check_triangles(const Triangles& shape, const std::string& at, Problems& problems) {
    if (shape.triangles.empty()) {
        add(problems,
            at + "/triangles",
            "no triangles",
            "the list is empty",
            "give three indices into 'vertices' for each triangle");
    }
    const auto count = static_cast<std::int64_t>(shape.vertices.size());
    for (std::size_t i = 0; i < shape.triangles.size(); ++i) {
        const auto& corners = shape.triangles[i];
        const std::string here = fmt::format("{}/triangles/{}", at, i);
        if (corners.size() != 3) {
            add(problems,
                here,
                fmt::format("{} indices; expected 3", corners.size()),
                "a polygon that is no triangle",
                "split it into triangles");
            continue;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            if (corners[k] >= count) {
                add(problems,
                    fmt::format("{}/{}", here, k),
                    fmt::format("index {}, but there are {} vertices", corners[k], count),
                    "indices count from 0",
                    "give an index below the number of vertices");
            }
        }
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) {
            add(problems,
                here,
                "a triangle with two equal corners",
                "an index is repeated",
                "give three different indices");
        }
    }
}

void check_shape(const WallShape& shape, const std::string& at, Problems& problems) {
    std::visit(
        Overloaded{
            [&](const Plane& s) { check_direction(s.normal, at + "/normal", problems); },
            [&](const Disc& s) {
                check_direction(s.normal, at + "/normal", problems);
                if (!(s.hole < s.radius)) {
                    add(problems,
                        at + "/hole",
                        fmt::format("the hole's radius, {} m, is not below the disc's", s.hole),
                        "nothing would be left of the disc",
                        "give a smaller hole");
                }
            },
            [&](const BoxShape& s) { check_box(s.low, s.high, at, problems); },
            [&](const Cylinder& s) { check_direction(s.axis, at + "/axis", problems); },
            [&](const FacetedCylinder& s) { check_direction(s.axis, at + "/axis", problems); },
            [&](const MeshFile& s) {
                for (const auto& corners : s.triangles) {
                    if (*std::max_element(corners.begin(), corners.end()) >= s.vertices.size()) {
                        add(problems,
                            at + "/path",
                            "a triangle names a vertex that does not exist",
                            "the file is damaged",
                            "write the mesh again");
                        return;
                    }
                }
            },
            [&](const Triangles& s) { check_triangles(s, at, problems); }},
        shape);
}

void check_table(const TableMotion& table, const std::string& at, Problems& problems) {
    check_direction(table.direction, at + "/direction", problems);
    if (table.times.size() != table.speeds.size()) {
        add(problems,
            at + "/speeds",
            fmt::format("{} speeds for {} times", table.speeds.size(), table.times.size()),
            "an entry is missing or too many",
            "give one speed for each time");
    }
    if (table.times.size() < 2) {
        add(problems,
            at + "/times",
            "fewer than two times",
            "a table needs a start and an end",
            "add times, or use the motion 'constant'");
        return;
    }
    if (table.times[0] != 0.0) {
        add(problems,
            at + "/times/0",
            fmt::format("the first time is {} s", table.times[0]),
            "times count from the start of the motion",
            "begin with 0");
    }
    for (std::size_t i = 1; i < table.times.size(); ++i) {
        if (!(table.times[i] > table.times[i - 1])) {
            add(problems,
                fmt::format("{}/times/{}", at, i),
                fmt::format("{} s does not come after {} s", table.times[i], table.times[i - 1]),
                "times are not in order, or one is repeated",
                "give ascending times");
            return;
        }
    }
}

}  // namespace

void check_unique_names(const std::vector<std::string_view>& names,
                        const std::string& pointer,
                        Problems& problems) {
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string at = fmt::format("{}/{}/name", pointer, i);
        if (names[i].empty()) {
            add(problems, at, "an empty name", "left blank", "give a name");
        } else if (std::find(names.begin(),
                             names.begin() + static_cast<std::ptrdiff_t>(i),
                             names[i]) != names.begin() + static_cast<std::ptrdiff_t>(i)) {
            add(problems,
                at,
                fmt::format("the name '{}' is taken", names[i]),
                "an entry was copied and not renamed",
                "give each a name of its own");
        }
    }
}

void check_known(std::string_view name,
                 const std::vector<std::string_view>& known,
                 std::string_view kind,
                 const std::string& pointer,
                 Problems& problems) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
        problems.add(unknown_name(pointer, kind, name, known));
    }
}

void check_direction(const Vec3& direction, const std::string& pointer, Problems& problems) {
    // The square must not underflow either: directions are divided by their length.
    if (!(norm(direction) > 0.0)) {
        add(problems,
            pointer,
            "a direction of length 0",
            "all components are 0",
            "give a direction such as [0, 0, 1]");
    }
}

void check_box(const Vec3& low, const Vec3& high, const std::string& pointer, Problems& problems) {
    const double lows[3] = {low.x, low.y, low.z};
    const double highs[3] = {high.x, high.y, high.z};
    for (std::size_t k = 0; k < 3; ++k) {
        if (!(lows[k] < highs[k])) {
            add(problems,
                fmt::format("{}/high/{}", pointer, k),
                fmt::format("{} m is not above the low corner's {} m", highs[k], lows[k]),
                "the corners are swapped, or the box is flat",
                "give low < high on every axis");
        }
    }
}

void check_motion(const WallMotion& motion, const std::string& pointer, Problems& problems) {
    std::visit(Overloaded{[](const FixedMotion&) {},
                          [](const ConstantMotion&) {},
                          [](const SinusoidMotion&) {},
                          [&](const RotationMotion& m) {
                              check_direction(m.axis, pointer + "/axis", problems);
                          },
                          [&](const TableMotion& m) { check_table(m, pointer, problems); },
                          [&](const SmoothedSquareMotion& m) {
                              check_direction(m.direction, pointer + "/direction", problems);
                          }},
               motion);
}

void check_periodic(const Scene& scene, Problems& problems) {
    const Periodic& periodic = *scene.periodic;
    const std::pair<const std::optional<Interval>&, const char*> intervals[] = {
        {periodic.x, "x"}, {periodic.y, "y"}, {periodic.z, "z"}};
    bool any = false;
    for (const auto& [interval, axis] : intervals) {
        any = any || interval;
        if (interval && !(interval->low < interval->high)) {
            add(problems,
                fmt::format("/periodic/{}/high", axis),
                fmt::format("{} m is not above 'low', {} m", interval->high, interval->low),
                "the ends are swapped",
                "give low < high");
        }
    }
    if (!any) {
        add(problems,
            "/periodic",
            "no direction",
            "the object is empty",
            "give an interval such as \"x\": {\"low\": 0, \"high\": 0.1}, or leave 'periodic' out");
    }
}

void check_bodies(const Scene& scene, Problems& problems) {
    if (scene.periodic) {
        check_periodic(scene, problems);
    }
    const Particles& particles = scene.particles;
    const auto species = names_of(particles.species);
    check_unique_names(species, "/particles/species", problems);
    for (std::size_t i = 0; i < particles.insertion.size(); ++i) {
        check_insertion(
            scene, particles.insertion[i], fmt::format("/particles/insertion/{}", i), problems);
    }
    for (std::size_t i = 0; i < particles.removal.size(); ++i) {
        const Removal& removal = particles.removal[i];
        if (!(removal.low < removal.high)) {
            add(problems,
                fmt::format("/particles/removal/{}/high", i),
                fmt::format("{} m is not above 'low', {} m", removal.high, removal.low),
                "the ends are swapped",
                "give low < high");
        }
    }
    check_traffic(particles, problems);
    check_unique_names(names_of(scene.walls), "/walls", problems);
    for (std::size_t i = 0; i < scene.walls.size(); ++i) {
        const Wall& wall = scene.walls[i];
        const std::string at = fmt::format("/walls/{}", i);
        if (!wall.material &&
            std::find(species.begin(), species.end(), wall.name) != species.end()) {
            add(problems,
                at + "/name",
                fmt::format("'{}' is also the name of a species", wall.name),
                "contact.pairs could not tell them apart",
                "rename the wall, or give it a material");
        }
        if (wall.material && wall.material->empty()) {
            add(problems,
                at + "/material",
                "an empty name",
                "left blank",
                "give a name, or leave 'material' out");
        }
        check_shape(wall.shape, at + "/shape", problems);
        check_motion(wall.motion, at + "/motion", problems);
    }
}

}  // namespace grainbench::io
