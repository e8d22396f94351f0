#include "core/contact/wall_contacts.hpp"

#include <algorithm>

namespace grainbench {

namespace {

/// Entries in a part of the work: enough to be worth a thread.
constexpr Index part_size = 2048;

/// Adds the places of the bits of words [first, last).
void append_bits(std::span<const std::uint64_t> words,
                 std::size_t first,
                 std::size_t last,
                 std::vector<Index>& places) {
    for (std::size_t w = first; w < last; ++w) {
        for_each_bit(words[w], 64 * w, [&](Index place) { places.push_back(place); });
    }
}

std::size_t words_up_to(Index place) {
    return (std::size_t{place} + 63) / 64;
}

/// Calls visit(places) for each run of places whose entries are of one particle.
template <class Visit>
void for_each_particle(const PairList& list, std::span<const Index> places, const Visit& visit) {
    for (std::size_t first = 0; first < places.size();) {
        std::size_t last = first + 1;
        while (last < places.size() && list.i[places[last]] == list.i[places[first]]) {
            ++last;
        }
        visit(places.subspan(first, last - first));
        first = last;
    }
}

}  // namespace

WallContacts::WallContacts(const SearchSettings& settings, int history_size)
    : clock_(settings), objects_(history_size, 1) {}

Renewal WallContacts::update(std::uint64_t cycle,
                             bool looks_ahead,
                             const ParticleState& particles,
                             const WallBody& wall,
                             const Kernels& kernels,
                             const Workers& workers) {
    const Renewal due =
        clock_.due(cycle, looks_ahead, particles, wall.displacement(), !wall.is_turned(), kernels);
    if (due <= Renewal::objects) {
        clock_.choose_reach(due, particles.smallest_radius());
    }
    if (due == Renewal::candidates) {
        candidates_.build(clock_, particles, wall, workers);
    }
    if (due <= Renewal::objects) {
        renew(particles, wall, kernels, workers);
        just_renewed_ = clock_.is_started();
        clock_.renewed(due, cycle, particles, wall.displacement());
    }
    return due;
}

void WallContacts::change_population(const PopulationChange& change, const ParticleState& after) {
    const std::size_t count_before = touching_count();
    const Renumbered renumbered = objects_.renumber(change, false);
    pick_rows(force_, renumbered.touching_before, 4);
    records_.renumber(renumbered, count_before, [](double*) {});  // a wall is never body i
    candidates_.forget();
    cut_into_parts();
    clock_.expire(after);
}

PatchQuery WallContacts::query_of(const ParticleState& particles,
                                  const WallBody& wall,
                                  const PairList& list,
                                  Index first,
                                  Index last,
                                  double extra) const {
    PatchQuery query{
        .position = particles.positions().data(),
        .planes = wall.surface().planes().data(),
        .shells = wall.surface().shells().empty() ? nullptr : wall.surface().shells().data(),
        .particle = list.i.data() + first,
        .patch = list.j.data() + first,
        .count = last - first,
        .shift = {wall.displacement().x, wall.displacement().y, wall.displacement().z},
        .rotation = {},
        .rotated = wall.is_turned(),
        .scale = 1.0,
        // The reference engine takes nothing from the planes.
        .extra = clock_.settings().brute_force ? 1e300 : extra};
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            query.rotation[3 * row + column] = wall.rotation()[3 * column + row];
        }
    }
    return query;
}

PatchAnswers WallContacts::answers_from(Index first) {
    return {face_.data() + first / 64, doubt_.data() + first / 64, height_.data() + first};
}

void WallContacts::renew(const ParticleState& particles,
                         const WallBody& wall,
                         const Kernels& kernels,
                         const Workers& workers) {
    const PairList& list = candidates_.list();
    face_.resize(list.words());
    doubt_.resize(list.words());
    height_.resize(list.i.size());
    const Index count = list.count;
    workers.for_each((count + part_size - 1) / part_size, [&](std::size_t part) {
        const auto first = static_cast<Index>(part) * part_size;
        const Index last = std::min(first + part_size, count);
        PatchQuery query = query_of(particles, wall, list, first, last, 0.0);
        query.scale = 1.0 + clock_.object_reach();
        kernels.test_patches(query, answers_from(first));
        for (std::size_t w = first / 64; w < words_up_to(last); ++w) {
            face_[w] |= doubt_[w];
        }
    });
    objects_.renew(list, face_, kernels);
    cut_into_parts();
}

/// Cuts where a particle's first entry is the first of a word.
void WallContacts::cut_into_parts() {
    const PairList& list = objects_.list();
    std::size_t used = 0;
    for (Index first = 0; first < list.count; ++used) {
        Index last = first + part_size;
        while (last < list.count && list.i[last] == list.i[last - 1]) {
            last += 64;
        }
        last = std::min(last, list.count);
        if (used == parts_.size()) {
            parts_.emplace_back();
        }
        parts_[used].first = first;
        parts_[used].last = last;
        first = last;
    }
    parts_.resize(used);
    watches_all_ = true;
    face_.resize(list.words());
    doubt_.resize(list.words());
    now_.resize(list.words());
    height_.resize(list.i.size());
}

void WallContacts::test_all(const ParticleState& particles,
                            const WallBody& wall,
                            double extra,
                            const Kernels& kernels,
                            Part& part) {
    kernels.test_patches(query_of(particles, wall, objects_.list(), part.first, part.last, extra),
                         answers_from(part.first));
    const std::size_t first_word = part.first / 64;
    const std::size_t last_word = words_up_to(part.last);
    for (std::size_t w = first_word; w < last_word; ++w) {
        now_[w] = face_[w] | doubt_[w];
    }
    part.near.clear();
    append_bits(now_, first_word, last_word, part.near);
}

void WallContacts::test_watched(const ParticleState& particles,
                                const WallBody& wall,
                                double extra,
                                const Kernels& kernels,
                                Part& part) {
    kernels.test_patches(
        query_of(particles, wall, part.watched_list, 0, part.watched_list.count, extra),
        {part.watched_face.data(), part.watched_doubt.data(), part.watched_height.data()});
    for (std::size_t w = part.first / 64; w < words_up_to(part.last); ++w) {
        face_[w] = 0;
    }
    part.near.clear();
    for (std::size_t w = 0; w < part.watched_face.size(); ++w) {
        const std::uint64_t face = part.watched_face[w];
        for_each_bit(face | part.watched_doubt[w], 64 * w, [&](Index k) {
            const Index place = part.watched[k];
            part.near.push_back(place);
            height_[place] = part.watched_height[k];
            face_[place / 64] |= (face >> (k % 64) & 1) << (place % 64);
        });
    }
}

/// Watches what a test has found near.
void WallContacts::watch(Part& part) const {
    const PairList& list = objects_.list();
    part.watched = part.near;
    part.watched_list.clear();
    for (const Index place : part.watched) {
        part.watched_list.append(list.i[place], list.j[place]);
    }
    part.watched_list.pad();
    part.watched_face.resize(part.watched_list.words());
    part.watched_doubt.resize(part.watched_list.words());
    part.watched_height.resize(part.watched_list.i.size());
}

void WallContacts::look_ahead(const ParticleState& particles,
                              const WallBody& wall,
                              double reach,
                              const Kernels& kernels,
                              const Workers& workers) {
    constexpr double rounding = 1e-6;
    clock_.look_ahead(particles.smallest_radius());
    // Against a wall only the particle travels, relative to it: once the horizon, not twice.
    const double extra = reach + (1.0 + rounding) * clock_.horizon();
    workers.for_each(parts_.size(), [&](std::size_t p) {
        Part& part = parts_[p];
        test_all(particles, wall, extra, kernels, part);
        find_hits(particles, wall, extra, part);
        std::swap(part.hits, part.soon);
        watch(part);
    });
    watches_all_ = false;
}

void WallContacts::find_hits(const ParticleState& particles,
                             const WallBody& wall,
                             double extra,
                             Part& part) {
    const PairList& list = objects_.list();
    part.hits.clear();
    for_each_particle(list, part.near, [&](std::span<const Index> places) {
        if (places.size() == 1 && has_bit(face_, places[0])) {
            part.hits.push_back(to_space(face_hit(wall.surface(), places[0]), wall));
        } else if (!add_faces(particles, wall, places, part)) {
            resolve(particles, wall, extra, places, part);
        }
    });
}

/// The contact with the face of an entry, in the wall's frame.
WallContacts::Hit WallContacts::face_hit(const Surface& surface, Index place) const {
    const double height = height_[place];
    const double* plane = surface.planes().data() + 16 * std::size_t{objects_.list().j[place]};
    const Vec3 up{plane[0], plane[1], plane[2]};
    return {place, height > 0.0 ? -up : up, std::abs(height)};
}

WallContacts::Hit WallContacts::to_space(Hit hit, const WallBody& wall) {
    if (wall.is_turned()) {
        hit.normal = wall.direction_to_space(hit.normal);
    }
    return hit;
}

/// Faces in different places need no rule. False, and nothing added, if these entries do.
bool WallContacts::add_faces(const ParticleState& particles,
                             const WallBody& wall,
                             std::span<const Index> places,
                             Part& part) const {
    std::vector<Hit>& hits = part.hits;
    const std::size_t first = hits.size();
    for (const Index place : places) {
        const Hit hit = face_hit(wall.surface(), place);
        bool is_apart = has_bit(face_, place);
        for (std::size_t h = first; h < hits.size(); ++h) {
            const Vec3 apart = hit.distance * hit.normal - hits[h].distance * hits[h].normal;
            const double radius = particles.radius(objects_.list().i[place]);
            is_apart = is_apart && dot(apart, apart) > 1e-6 * radius * radius;
        }
        if (!is_apart) {
            hits.resize(first);
            return false;
        }
        hits.push_back(hit);
    }
    for (std::size_t h = first; h < hits.size(); ++h) {
        hits[h] = to_space(hits[h], wall);
    }
    return true;
}

void WallContacts::resolve(const ParticleState& particles,
                           const WallBody& wall,
                           double extra,
                           std::span<const Index> places,
                           Part& part) const {
    const PairList& list = objects_.list();
    const Index particle = list.i[places.front()];
    part.patches.clear();
    for (const Index place : places) {
        part.patches.push_back(list.j[place]);
    }
    WallHits found;
    wall.surface().resolve(wall.to_wall(particles.position(particle)),
                           particles.radius(particle) + extra,
                           part.patches,
                           found);
    const auto first = static_cast<std::ptrdiff_t>(part.hits.size());
    for (const WallHit& hit : found.view()) {
        const auto at = std::lower_bound(part.patches.begin(), part.patches.end(), hit.patch);
        part.hits.push_back({places[static_cast<std::size_t>(at - part.patches.begin())],
                             wall.direction_to_space(hit.normal),
                             hit.distance});
    }
    std::sort(part.hits.begin() + first, part.hits.end(), [](const Hit& a, const Hit& b) {
        return a.place < b.place;
    });
}

bool WallContacts::find_touching(const ParticleState& particles,
                                 const WallBody& wall,
                                 double reach,
                                 const Kernels& kernels,
                                 const Workers& workers) {
    workers.for_each(parts_.size(), [&](std::size_t p) {
        Part& part = parts_[p];
        if (watches_all_) {
            test_all(particles, wall, reach, kernels, part);
        } else {
            test_watched(particles, wall, reach, kernels, part);
        }
        find_hits(particles, wall, reach, part);
        part.has_changed = mark_hits(part);
        if (part.has_changed) {
            hand_over(wall.surface(), part);
        }
    });
    const bool changed = std::any_of(
        parts_.begin(), parts_.end(), [](const Part& part) { return part.has_changed; });
    if (changed && just_renewed_) {
        for (const Part& part : parts_) {
            adopt_late_contacts(part);
        }
    }
    just_renewed_ = false;
    objects_.set_touching(now_, true, kernels, workers);
    workers.for_each(parts_.size(), [&](std::size_t p) {
        for (const Hit& hit : parts_[p].hits) {
            const double geometry[4] = {hit.normal.x, hit.normal.y, hit.normal.z, hit.distance};
            std::copy_n(geometry, 4, objects_.extra(hit.place));
        }
    });
    return changed;
}

bool WallContacts::mark_hits(const Part& part) {
    const std::size_t first_word = part.first / 64;
    const std::size_t last_word = words_up_to(part.last);
    for (std::size_t w = first_word; w < last_word; ++w) {
        now_[w] = 0;
    }
    for (const Hit& hit : part.hits) {
        now_[hit.place / 64] |= std::uint64_t{1} << (hit.place % 64);
    }
    bool changed = false;
    for (std::size_t w = first_word; w < last_word; ++w) {
        changed = changed || now_[w] != objects_.acting()[w];
    }
    return changed;
}

/// What a patch has lost goes to a neighbour that goes on in its place, nearest direction first. A
/// face that is met while another is left must start from nothing. A patch farther on counts as a
/// neighbour where nothing but a sliver, passed within one step, can lie between: the same distance
/// in the same direction.
void WallContacts::hand_over(const Surface& surface, Part& part) {
    constexpr double smallest_cosine = 0.5;
    constexpr double same_direction = 0.9999;
    constexpr double same_distance = 1e-3;
    const PairList& list = objects_.list();
    part.opened.clear();
    for (std::size_t w = part.first / 64; w < words_up_to(part.last); ++w) {
        for_each_bit(objects_.acting()[w] & ~now_[w], 64 * w, [&](Index place) {
            part.opened.push_back(place);
        });
    }
    for_each_particle(list, part.opened, [&](std::span<const Index> opened) {
        const Index particle = list.i[opened.front()];
        const auto first = std::lower_bound(
            part.hits.begin(), part.hits.end(), particle, [&](const Hit& hit, Index wanted) {
                return list.i[hit.place] < wanted;
            });
        for (bool found = true; found;) {
            found = false;
            double best = smallest_cosine;
            std::pair<Index, Index> best_pair;
            for (auto hit = first; hit != part.hits.end() && list.i[hit->place] == particle;
                 ++hit) {
                for (const Index from : opened) {
                    const double* old = objects_.extra(from);
                    const double cosine = dot(hit->normal, Vec3{old[0], old[1], old[2]});
                    const bool goes_on =
                        surface.adjacent(list.j[from], list.j[hit->place]) ||
                        (cosine > same_direction &&
                         std::abs(hit->distance - old[3]) < same_distance * old[3]);
                    if (objects_.acts(from) && !objects_.acts(hit->place) && cosine > best &&
                        goes_on) {
                        best = cosine;
                        best_pair = {from, hit->place};
                        found = true;
                    }
                }
            }
            if (found) {
                objects_.hand_over(best_pair.first, best_pair.second);
            }
        }
    });
}

/// Near only since this renewal and overlapping already: found late.
void WallContacts::adopt_late_contacts(const Part& part) {
    const PairList& list = objects_.list();
    for_each_particle(list, part.near, [&](std::span<const Index> places) {
        const bool was_near = std::any_of(places.begin(), places.end(), [&](Index place) {
            return objects_.was_listed(list.i[place], list.j[place]);
        });
        for (const Index place : places) {
            if (!was_near && has_bit(now_, place) && !objects_.acts(place)) {
                objects_.set_acting(place);
                ++late_;
            }
        }
    });
}

std::pair<Index, Index> WallContacts::touching_of(const Part& part) const {
    const auto touching = objects_.touching();
    const auto first_from = [&](Index entry) {
        return static_cast<Index>(
            std::partition_point(touching.begin(),
                                 touching.end(),
                                 [&](TouchingContact contact) { return contact.place() < entry; }) -
            touching.begin());
    };
    return {first_from(part.first), first_from(part.last)};
}

void WallContacts::add_forces(ParticleState& particles,
                              const WallBody& wall,
                              const ContactTable& table,
                              double timestep,
                              Records records,
                              const Kernels& kernels,
                              const Workers& workers) {
    const std::size_t count = touching_count();
    records_.prepare(records, count);
    force_.resize(4 * count);
    const WallVelocity& velocity = wall.velocity();
    const Vec3& centre = wall.rotation_centre();
    const ParticleView view = particles.view();
    workers.for_each(parts_.size(), [&](std::size_t p) {
        const auto [first, last] = touching_of(parts_[p]);
        kernels.wall_pass({.particles = view,
                           .laws = table.view(timestep),
                           .particle = objects_.list().i.data(),
                           .touching = objects_.touching().data() + first,
                           .touching_count = last - first,
                           .velocity = {velocity.linear.x, velocity.linear.y, velocity.linear.z},
                           .spin = {velocity.angular.x, velocity.angular.y, velocity.angular.z},
                           .centre = {centre.x, centre.y, centre.z},
                           .material = static_cast<double>(wall.material()),
                           .rows = objects_.rows(),
                           .force = force_.data() + 4 * std::size_t{first},
                           .records = records_.rows_from(first),
                           .stored = records_.stored_from(first)});
    });
}

void WallContacts::add_steps(ParticleState& particles,
                             const WallBody& wall,
                             const ContactTable& table,
                             bool touching_only,
                             const StepSums& sums,
                             const Kernels& kernels,
                             const Workers& workers) {
    const ParticleView view = particles.view();
    workers.for_each(parts_.size(), [&](std::size_t p) {
        Part& part = parts_[p];
        if (touching_only) {
            part.hits.clear();
            const auto [first, last] = touching_of(part);
            for (Index t = first; t < last; ++t) {
                part.hits.push_back({place(t), normal(t), distance(t)});
            }
        }
        part.step_particle.clear();
        part.step_geometry.clear();
        for (const Hit& hit : touching_only ? part.hits : part.soon) {
            part.step_particle.push_back(objects_.list().i[hit.place]);
            part.step_geometry.insert(part.step_geometry.end(),
                                      {hit.normal.x, hit.normal.y, hit.normal.z, hit.distance});
        }
        kernels.add_wall_steps({.particles = view,
                                .laws = table.view(0.0),
                                .particle = part.step_particle.data(),
                                .geometry = part.step_geometry.data(),
                                .count = static_cast<Index>(part.step_particle.size()),
                                .material = static_cast<double>(wall.material()),
                                .sums = sums});
    });
}

Vec3 WallContacts::point(const ParticleState& particles, Index t) const {
    return particles.position(particle(t)) + distance(t) * normal(t);
}

std::size_t WallContacts::compute_object_count(const ParticleState& particles,
                                               const WallBody& wall) const {
    const PairList& list = objects_.list();
    std::size_t count = 0;
    WallHits found;
    for (Index first = 0; first < list.count;) {
        const Index particle = list.i[first];
        Index last = first;
        while (last < list.count && list.i[last] == particle) {
            ++last;
        }
        wall.surface().resolve(wall.to_wall(particles.position(particle)),
                               (1.0 + clock_.settings().tolerance) * particles.radius(particle),
                               {list.j.data() + first, last - first},
                               found);
        count += found.count;
        first = last;
    }
    return count;
}

void WallContacts::save(Archive& archive, const std::string& name, Records records) const {
    clock_.save(archive, name);
    candidates_.save(archive, name);
    objects_.save(archive, name + "/objects");
    archive.put(name + "/force", std::vector<double>(force_.begin(), force_.end()));
    records_.save(archive, name, records);
    archive.put(name + "/late", late_);
}

void WallContacts::load(const Archive& archive,
                        const std::string& name,
                        const ParticleState& particles,
                        const WallBody& wall,
                        Records records) {
    const std::size_t size = particles.size();
    const std::size_t patches = wall.surface().patch_count();
    clock_.load(archive, name, particles);
    candidates_.load(archive, name, size, patches);
    objects_.load(archive, name + "/objects", size, patches);
    cut_into_parts();
    const auto& force = archive.get<double>(name + "/force", 4 * std::size_t{touching_count()});
    force_.assign(force.begin(), force.end());
    records_.load(archive, name, records, touching_count());
    late_ = archive.count(name + "/late");
}

}  // namespace grainbench
