#include "core/insertion/insert.hpp"

#include "core/describe.hpp"
#include "core/error.hpp"
#include "core/insertion/sphere_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <string>
#include <utility>

namespace grainbench {

namespace {

/// Uniform numbers that are the same on every machine; std::uniform_real_distribution may differ.
class Uniform {
public:
    explicit Uniform(std::uint64_t seed) : generator_(seed) {}

    /// In [0, 1), a multiple of 2^-53.
    double next() { return static_cast<double>(generator_() >> 11U) * 0x1p-53; }

private:
    std::mt19937_64 generator_;
};

class Inserter {
public:
    Inserter(const Scene& scene, std::span<const Surface> walls, std::uint64_t seed)
        : scene_(scene), walls_(walls), uniform_(seed), placed_(all_radii(scene)) {}

    InsertionResult insert_all() {
        const std::vector<Insertion>& entries = scene_.particles.insertion;
        for (std::size_t k = 0; k < entries.size(); ++k) {
            where_ = "/particles/insertion/" + std::to_string(k);
            result_.reports.push_back(
                std::visit([&](const auto& entry) { return insert(entry); }, entries[k]));
        }
        remove_slices();
        return std::move(result_);
    }

private:
    static std::vector<double> all_radii(const Scene& scene) {
        std::vector<double> radii;
        for (const Species& species : scene.particles.species) {
            radii.push_back(species.radius);
        }
        for (const Insertion& entry : scene.particles.insertion) {
            if (const auto* file = std::get_if<FileInsertion>(&entry)) {
                for (const FileInsertion::Row& row : file->imported) {
                    if (row.radius > 0.0) {
                        radii.push_back(row.radius);
                    }
                }
            }
        }
        return radii;
    }

    InsertionReport insert(const RandomInsertion& entry) {
        const Index species = species_named(entry.species, where_ + "/species");
        const double radius = radius_of(species);
        const Surface* holder = entry.inside ? &wall_named(*entry.inside) : nullptr;
        const Vec3 margin{radius, radius, radius};
        const Vec3 low = entry.box.low + margin;
        const Vec3 size = entry.box.high - margin - low;
        if (entry.count > 0 && !(std::min({size.x, size.y, size.z}) >= 0.0)) {
            throw_bad_input({.what = "the box of a random insertion holds no sphere of \"" +
                                     entry.species + "\"",
                             .where = where_ + "/box",
                             .likely_cause =
                                 "the box bounds surfaces, not centres, and is narrower "
                                 "than a sphere; or low and high are swapped",
                             .next_step = "widen the box"});
        }
        InsertionReport report{.asked = entry.count};
        while (report.placed < entry.count && report.tries < entry.tries) {
            ++report.tries;
            const double x = low.x + uniform_.next() * size.x;
            const double y = low.y + uniform_.next() * size.y;
            const double z = low.z + uniform_.next() * size.z;
            const Vec3 centre{x, y, z};
            if ((holder == nullptr || holder->encloses(centre, radius)) &&
                !placed_.overlaps(centre, radius) && is_clear_of_walls(centre, radius)) {
                place({.species = species, .radius = radius, .position = centre});
                ++report.placed;
            }
        }
        return report;
    }

    InsertionReport insert(const LatticeInsertion& entry) {
        const Index species = species_named(entry.species, where_ + "/species");
        if (entry.counts.size() != 3) {
            throw_bad_input({.what = "a lattice has three numbers of spheres",
                             .where = where_ + "/counts",
                             .likely_cause = std::to_string(entry.counts.size()) + " are given",
                             .next_step = "give the numbers along x, y and z, such as [4, 4, 10]"});
        }
        const std::int64_t nx = entry.counts[0];
        const std::int64_t ny = entry.counts[1];
        const std::int64_t nz = entry.counts[2];
        const Vec3& step = entry.spacing;
        if ((nx > 1 && step.x == 0.0) || (ny > 1 && step.y == 0.0) || (nz > 1 && step.z == 0.0)) {
            throw_bad_input({.what = "spheres of a lattice would lie in the same place",
                             .where = where_ + "/spacing",
                             .likely_cause = "the spacing is 0 along an axis with several spheres",
                             .next_step = "use a spacing of at least two radii"});
        }
        check_room(static_cast<double>(nx) * static_cast<double>(ny) * static_cast<double>(nz));
        const auto moved = [&](double at) {
            return entry.jitter > 0.0 ? at + (2.0 * uniform_.next() - 1.0) * entry.jitter : at;
        };
        for (std::int64_t n = 0; n < nx * ny * nz; ++n) {
            const std::int64_t row = n / nx;
            const std::int64_t layer = row / ny;
            const double x = moved(entry.origin.x + static_cast<double>(n % nx) * step.x);
            const double y = moved(entry.origin.y + static_cast<double>(row % ny) * step.y);
            const double z = moved(entry.origin.z + static_cast<double>(layer) * step.z);
            place({.species = species,
                   .radius = radius_of(species),
                   .position = {x, y, z},
                   .velocity = entry.velocity});
        }
        return certain(nx * ny * nz);
    }

    InsertionReport insert(const ListInsertion& entry) {
        for (std::size_t k = 0; k < entry.particles.size(); ++k) {
            const Placement& p = entry.particles[k];
            const std::string where = where_ + "/particles/" + std::to_string(k);
            const Index species = species_named(p.species, where + "/species");
            place_checked({species, radius_of(species), p.position, p.velocity, p.angular_velocity},
                          where);
        }
        return certain(static_cast<std::int64_t>(entry.particles.size()));
    }

    InsertionReport insert(const FileInsertion& entry) {
        for (std::size_t k = 0; k < entry.imported.size(); ++k) {
            const FileInsertion::Row& row = entry.imported[k];
            const std::string where =
                where_ + ", sphere " + std::to_string(k) + " (from 0) of " + entry.path;
            const Index species =
                species_named(row.species.empty() ? entry.species : row.species, where);
            const double radius = row.radius == 0.0 ? radius_of(species) : row.radius;
            place_checked({species, radius, row.position, row.velocity, row.angular_velocity},
                          where);
        }
        return certain(static_cast<std::int64_t>(entry.imported.size()));
    }

    static InsertionReport certain(std::int64_t count) {
        return {.asked = count, .placed = count, .tries = count};
    }

    Index species_named(const std::string& name, const std::string& where) const {
        const std::vector<Species>& all = scene_.particles.species;
        const auto found = std::find_if(
            all.begin(), all.end(), [&](const Species& species) { return species.name == name; });
        if (found == all.end()) {
            throw_bad_input({.what = "there is no species \"" + name + "\"",
                             .where = where,
                             .likely_cause = "the name is misspelt or the species is missing",
                             .next_step = "use a name from /particles/species"});
        }
        return static_cast<Index>(found - all.begin());
    }

    double radius_of(Index species) const { return scene_.particles.species[species].radius; }

    const Surface& wall_named(const std::string& name) const {
        for (std::size_t k = 0; k < walls_.size(); ++k) {
            if (scene_.walls[k].name == name) {
                return walls_[k];
            }
        }
        throw_bad_input({.what = "there is no wall \"" + name + "\"",
                         .where = where_ + "/inside",
                         .likely_cause = "the name is misspelt or the wall is missing",
                         .next_step = "use the name of a closed wall from /walls"});
    }

    bool is_clear_of_walls(const Vec3& centre, double radius) {
        return std::all_of(walls_.begin(), walls_.end(), [&](const Surface& wall) {
            near_.clear();
            wall.collect(centre, radius, near_);
            return near_.empty();
        });
    }

    void check_room(double more) const {
        if (static_cast<double>(result_.spheres.size()) + more >=
            static_cast<double>(std::numeric_limits<Index>::max())) {
            throw_bad_input({.what = "the scene asks for more spheres than can be numbered",
                             .where = where_,
                             .likely_cause = "a count is far too large",
                             .next_step = "ask for fewer spheres"});
        }
    }

    void place_checked(const Sphere& sphere, const std::string& where) {
        if (!is_finite(sphere.position) || !is_finite(sphere.velocity) ||
            !is_finite(sphere.angular_velocity) || !std::isfinite(sphere.radius) ||
            !(sphere.radius > 0.0)) {
            throw_bad_input({.what = "a sphere has a number that is not finite, or no radius",
                             .where = where,
                             .likely_cause = "a column is empty, damaged or negative",
                             .next_step = "correct the row"});
        }
        place(sphere);
    }

    void place(const Sphere& sphere) {
        placed_.add(sphere.position, sphere.radius);
        result_.spheres.push_back(sphere);
    }

    void remove_slices() {
        for (const Removal& slice : scene_.particles.removal) {
            const double Vec3::*axis = slice.axis == Axis::x   ? &Vec3::x
                                       : slice.axis == Axis::y ? &Vec3::y
                                                               : &Vec3::z;
            std::erase_if(result_.spheres, [&](const Sphere& sphere) {
                return sphere.position.*axis > slice.low && sphere.position.*axis < slice.high;
            });
        }
    }

    const Scene& scene_;
    std::span<const Surface> walls_;
    Uniform uniform_;
    SphereGrid placed_;
    std::string where_;
    std::vector<Index> near_;
    InsertionResult result_;
};

}  // namespace

InsertionResult insert_particles(const Scene& scene,
                                 std::span<const Surface> walls,
                                 std::uint64_t seed) {
    return Inserter(scene, walls, seed).insert_all();
}

}  // namespace grainbench
