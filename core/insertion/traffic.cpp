#include "core/insertion/traffic.hpp"

#include "core/insertion/sphere_grid.hpp"

#include <algorithm>
#include <cmath>

namespace grainbench {

namespace {

/// Room that a newcomer keeps around it, over its radius.
constexpr double clearance = 0.01;

/// Number `draw` of the sequence of a seed, uniform in [0, 1): SplitMix64 of Steele, Lea and Flood
/// (2014), which needs no state but the two, so that a checkpoint keeps one count.
double uniform(std::uint64_t seed, std::uint64_t draw) {
    std::uint64_t z = seed + (draw + 1) * 0x9e3779b97f4a7c15ULL;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
    return static_cast<double>((z ^ (z >> 31U)) >> 11U) * 0x1p-53;
}

bool catches(const Sink& sink, const Vec3& p) {
    const double x = sink.axis == Axis::x ? p.x : sink.axis == Axis::y ? p.y : p.z;
    return x > sink.low && x < sink.high && (!sink.box || holds(*sink.box, p));
}

}  // namespace

Traffic::Traffic(const Scene& scene, std::uint64_t seed) : sinks_(scene.particles.sinks) {
    for (const Sink& sink : sinks_) {
        went_.push_back({.name = sink.name});
    }
    const std::vector<Species>& species = scene.particles.species;
    for (const Species& one : species) {
        radii_.push_back(one.radius);
    }
    for (const Source& source : scene.particles.sources) {
        const auto at = std::find_if(species.begin(), species.end(), [&](const Species& one) {
            return one.name == source.species;
        });
        if (at == species.end()) {
            throw_bad_input(
                {.what = "there is no species \"" + source.species + "\"",
                 .where = "/particles/sources/" + std::to_string(feeds_.size()) + "/species",
                 .likely_cause = "the name is misspelt or the species is missing",
                 .next_step = "use a name from /particles/species"});
        }
        // Sources must not draw the same numbers as each other.
        const auto own_seed = static_cast<std::uint64_t>(0x1p63 * uniform(seed, feeds_.size()));
        feeds_.push_back({.source = source,
                          .species = static_cast<Index>(at - species.begin()),
                          .radius = at->radius,
                          .mass = sphere_mass(at->density, at->radius),
                          .seed = own_seed});
        came_.push_back({.name = source.name});
    }
}

std::optional<PopulationChange> Traffic::next_change(const ParticleState& particles,
                                                     std::span<const WallBody> walls,
                                                     double time) {
    PopulationChange change = particles.departure_of(let_out(particles));
    let_in(particles, walls, time, change);
    if (change.leavers.empty() && change.newcomers.empty()) {
        return std::nullopt;
    }
    return change;
}

/// Counts those that lie in a sink, and returns their slots.
std::vector<Index> Traffic::let_out(const ParticleState& particles) {
    std::vector<Index> caught;
    for (Index slot = 0; slot < particles.size(); ++slot) {
        const Vec3 p = particles.box().wrapped(particles.position(slot));
        const auto sink = std::find_if(
            sinks_.begin(), sinks_.end(), [&](const Sink& one) { return catches(one, p); });
        if (sink == sinks_.end()) {
            continue;
        }
        caught.push_back(slot);
        Passage& passage = went_[static_cast<std::size_t>(sink - sinks_.begin())];
        ++passage.count;
        passage.mass += particles.mass(slot);
    }
    return caught;
}

/// Spheres that should be there by now and are not.
std::int64_t Traffic::owed(const Feed& feed, std::int64_t placed, double time) const {
    const Source& source = feed.source;
    const double until = std::min(time, source.end.value_or(time));
    if (until < source.start) {
        return 0;
    }
    const double due = std::floor(source.rate * (until - source.start)) + 1.0;  // one at the start
    const double most = static_cast<double>(source.count.value_or(1LL << 40));
    return static_cast<std::int64_t>(std::min(due, most)) - placed;
}

void Traffic::let_in(const ParticleState& particles,
                     std::span<const WallBody> walls,
                     double time,
                     PopulationChange& change) {
    std::optional<SphereGrid> present;  // built once somebody is due
    std::vector<Index> near;
    std::vector<Vec3> shifts;
    for (std::size_t s = 0; s < feeds_.size(); ++s) {
        Feed& feed = feeds_[s];
        const Source& source = feed.source;
        std::int64_t wanted = owed(feed, came_[s].count, time);
        if (wanted <= 0) {
            continue;
        }
        if (!present) {
            std::vector<double> radii = radii_;
            for (Index slot = 0; slot < particles.size(); ++slot) {
                radii.push_back(particles.radius(slot));
            }
            present.emplace(radii);
            for (Index slot = 0; slot < particles.size(); ++slot) {
                if (change.slot_after[slot] != PopulationChange::gone) {
                    present->add(particles.box().wrapped(particles.position(slot)),
                                 particles.radius(slot));
                }
            }
        }
        const double room = (1.0 + clearance) * feed.radius;
        const Vec3 margin{feed.radius, feed.radius, feed.radius};
        const Vec3 low = source.box.low + margin;
        const Vec3 size = source.box.high - margin - low;
        const auto overlaps = [&](const Vec3& centre) {
            shifts.assign(1, {});  // and beyond periodic boundaries
            particles.box().collect_shifts(centre, 2.0 * particles.largest_radius(), shifts);
            return std::any_of(shifts.begin(), shifts.end(), [&](const Vec3& shift) {
                return present->overlaps(centre + shift, room);
            });
        };
        const auto is_free = [&](const Vec3& centre) {
            return !overlaps(centre) &&
                   std::all_of(walls.begin(), walls.end(), [&](const WallBody& wall) {
                       near.clear();
                       wall.surface().collect(wall.to_wall(centre), room, near);
                       return near.empty();
                   });
        };
        // The first that finds no room ends the look: the box is full.
        for (std::int64_t tries = source.tries; wanted > 0 && tries > 0; --tries) {
            const double x = low.x + uniform(feed.seed, feed.draws) * size.x;
            const double y = low.y + uniform(feed.seed, feed.draws + 1) * size.y;
            const double z = low.z + uniform(feed.seed, feed.draws + 2) * size.z;
            feed.draws += 3;
            const Vec3 centre = particles.box().wrapped({x, y, z});
            if (!is_free(centre)) {
                continue;
            }
            present->add(centre, feed.radius);
            change.newcomers.push_back({.species = feed.species,
                                        .radius = feed.radius,
                                        .position = centre,
                                        .velocity = source.velocity});
            --wanted;
            tries = source.tries + 1;
            ++came_[s].count;
            came_[s].mass += feed.mass;
        }
    }
}

void Traffic::save(Archive& archive) const {
    std::vector<std::uint64_t> counts;
    std::vector<double> masses;
    const auto put = [&](const Passage& passage) {
        counts.push_back(static_cast<std::uint64_t>(passage.count));
        masses.push_back(passage.mass);
    };
    std::for_each(went_.begin(), went_.end(), put);
    std::for_each(came_.begin(), came_.end(), put);
    for (const Feed& feed : feeds_) {
        counts.push_back(feed.draws);
    }
    archive.put("traffic/counts", counts);
    archive.put("traffic/masses", masses);
}

void Traffic::load(const Archive& archive) {
    const std::size_t passages = went_.size() + came_.size();
    const auto& counts = archive.get<std::uint64_t>("traffic/counts", passages + feeds_.size());
    const auto& masses = archive.get<double>("traffic/masses", passages);
    std::size_t k = 0;
    for (std::vector<Passage>* passed : {&went_, &came_}) {
        for (Passage& passage : *passed) {
            passage.count = static_cast<std::int64_t>(counts[k]);
            passage.mass = masses[k++];
        }
    }
    for (Feed& feed : feeds_) {
        feed.draws = counts[k++];
    }
}

}  // namespace grainbench
