#include "core/contact/wall_contacts.hpp"

#include <algorithm>

namespace grainbench {

namespace {

void append_bits(std::span<const std::uint64_t> words, std::vector<Index>& places) {
    for (std::size_t w = 0; w < words.size(); ++w) {
        for (std::uint64_t bits = words[w]; bits != 0; bits &= bits - 1) {
            places.push_back(static_cast<Index>(64 * w) +
                             static_cast<Index>(__builtin_ctzll(bits)));
        }
    }
}

bool has_bit(std::span<const std::uint64_t> words, Index place) {
    return (words[place / 64] >> (place % 64) & 1) != 0;
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
                             const ParticleState& particles,
                             const WallBody& wall,
                             const Kernels& kernels) {
    const Renewal due =
        clock_.due(cycle, particles, wall.displacement(), !wall.is_turned(), kernels);
    if (due == Renewal::candidates) {
        build_candidates(particles, wall);
    }
    if (due <= Renewal::objects) {
        renew(particles, wall, kernels);
        just_renewed_ = clock_.is_started();
        clock_.renewed(due, cycle, particles, wall.displacement());
    }
    return due;
}

void WallContacts::build_candidates(const ParticleState& particles, const WallBody& wall) {
    const SearchSettings& settings = clock_.settings();
    candidates_.clear();
    for (Index slot = 0; slot < particles.size(); ++slot) {
        patches_.clear();
        const double reach =
            settings.brute_force
                ? 1e300
                : (1.0 + settings.tolerance) * particles.radius(slot) + settings.slack;
        wall.surface().collect(wall.to_wall(particles.position(slot)), reach, patches_);
        for (const Index patch : patches_) {
            candidates_.append(slot, patch);
        }
    }
    candidates_.pad();
}

void WallContacts::test(const ParticleState& particles,
                        const WallBody& wall,
                        const PairList& list,
                        double scale,
                        double extra,
                        const Kernels& kernels) {
    face_.resize(list.words());
    doubt_.resize(list.words());
    height_.resize(list.i.size());
    PatchQuery query{.position = particles.positions().data(),
                     .planes = wall.surface().planes().data(),
                     .particle = list.i.data(),
                     .patch = list.j.data(),
                     .count = list.count,
                     .shift = {wall.displacement().x, wall.displacement().y, wall.displacement().z},
                     .rotation = {},
                     .rotated = wall.is_turned(),
                     .scale = scale,
                     // The reference engine takes nothing from the planes.
                     .extra = clock_.settings().brute_force ? 1e300 : extra};
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            query.rotation[3 * row + column] = wall.rotation()[3 * column + row];
        }
    }
    kernels.test_patches(query, {face_.data(), doubt_.data(), height_.data()});
}

void WallContacts::renew(const ParticleState& particles,
                         const WallBody& wall,
                         const Kernels& kernels) {
    test(particles, wall, candidates_, 1.0 + clock_.settings().tolerance, 0.0, kernels);
    for (std::size_t w = 0; w < face_.size(); ++w) {
        face_[w] |= doubt_[w];
    }
    fresh_.clear();
    append_bits(face_, fresh_);
    objects_.renew(candidates_, fresh_);
}

void WallContacts::find_hits(const ParticleState& particles,
                             const WallBody& wall,
                             double extra,
                             const Kernels& kernels) {
    const PairList& list = objects_.list();
    test(particles, wall, list, 1.0, extra, kernels);
    now_.resize(list.words());
    for (std::size_t w = 0; w < now_.size(); ++w) {
        now_[w] = face_[w] | doubt_[w];
    }
    fresh_.clear();
    append_bits(now_, fresh_);
    hits_.clear();
    for_each_particle(list, fresh_, [&](std::span<const Index> places) {
        if (!add_faces(particles, wall, places)) {
            resolve(particles, wall, extra, places);
        }
    });
}

/// Faces in different places need no rule. False, and nothing added, if these entries do.
bool WallContacts::add_faces(const ParticleState& particles,
                             const WallBody& wall,
                             std::span<const Index> places) {
    const std::size_t first = hits_.size();
    const double* planes = wall.surface().planes().data();
    for (const Index place : places) {
        const double height = height_[place];
        const double* plane = planes + 16 * std::size_t{objects_.list().j[place]};
        const Vec3 up{plane[0], plane[1], plane[2]};
        const Hit hit{place, height > 0.0 ? -up : up, std::abs(height)};
        bool is_apart = has_bit(face_, place);
        for (std::size_t h = first; h < hits_.size(); ++h) {
            const Vec3 apart = hit.distance * hit.normal - hits_[h].distance * hits_[h].normal;
            const double radius = particles.radius(objects_.list().i[place]);
            is_apart = is_apart && dot(apart, apart) > 1e-6 * radius * radius;
        }
        if (!is_apart) {
            hits_.resize(first);
            return false;
        }
        hits_.push_back(hit);
    }
    for (std::size_t h = first; h < hits_.size(); ++h) {
        hits_[h].normal = wall.direction_to_space(hits_[h].normal);
    }
    return true;
}

void WallContacts::resolve(const ParticleState& particles,
                           const WallBody& wall,
                           double extra,
                           std::span<const Index> places) {
    const PairList& list = objects_.list();
    const Index particle = list.i[places.front()];
    patches_.clear();
    for (const Index place : places) {
        patches_.push_back(list.j[place]);
    }
    WallHits found;
    wall.surface().resolve(wall.to_wall(particles.position(particle)),
                           particles.radius(particle) + extra,
                           patches_,
                           found);
    const std::size_t first = hits_.size();
    for (const WallHit& hit : found.view()) {
        const auto at = std::lower_bound(patches_.begin(), patches_.end(), hit.patch);
        hits_.push_back({places[static_cast<std::size_t>(at - patches_.begin())],
                         wall.direction_to_space(hit.normal),
                         hit.distance});
    }
    std::sort(hits_.begin() + static_cast<std::ptrdiff_t>(first),
              hits_.end(),
              [](const Hit& a, const Hit& b) { return a.place < b.place; });
}

bool WallContacts::find_touching(const ParticleState& particles,
                                 const WallBody& wall,
                                 const Kernels& kernels) {
    find_hits(particles, wall, 0.0, kernels);
    std::fill(now_.begin(), now_.end(), 0);
    for (const Hit& hit : hits_) {
        now_[hit.place / 64] |= std::uint64_t{1} << (hit.place % 64);
    }
    bool changed = false;
    for (std::size_t w = 0; w < now_.size(); ++w) {
        changed = changed || now_[w] != objects_.acting()[w];
    }
    if (changed) {
        hand_over(wall.surface());
        if (just_renewed_) {
            adopt_late_contacts();
        }
    }
    just_renewed_ = false;
    objects_.set_touching(now_);
    for (const Hit& hit : hits_) {
        const double geometry[4] = {hit.normal.x, hit.normal.y, hit.normal.z, hit.distance};
        std::copy_n(geometry, 4, objects_.extra(hit.place));
    }
    return changed;
}

/// What a patch has lost goes to a neighbour that goes on in its place, nearest direction first. A
/// face that is met while another is left must start from nothing. A patch farther on counts as a
/// neighbour where nothing but a sliver, passed within one step, can lie between: the same distance
/// in the same direction.
void WallContacts::hand_over(const Surface& surface) {
    constexpr double smallest_cosine = 0.5;
    constexpr double same_direction = 0.9999;
    constexpr double same_distance = 1e-3;
    const PairList& list = objects_.list();
    opened_.clear();
    for (std::size_t w = 0; w < now_.size(); ++w) {
        for (std::uint64_t bits = objects_.acting()[w] & ~now_[w]; bits != 0; bits &= bits - 1) {
            opened_.push_back(static_cast<Index>(64 * w) +
                              static_cast<Index>(__builtin_ctzll(bits)));
        }
    }
    for_each_particle(list, opened_, [&](std::span<const Index> opened) {
        const Index particle = list.i[opened.front()];
        const auto first = std::lower_bound(
            hits_.begin(), hits_.end(), particle, [&](const Hit& hit, Index wanted) {
                return list.i[hit.place] < wanted;
            });
        for (bool found = true; found;) {
            found = false;
            double best = smallest_cosine;
            std::pair<Index, Index> best_pair;
            for (auto hit = first; hit != hits_.end() && list.i[hit->place] == particle; ++hit) {
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
void WallContacts::adopt_late_contacts() {
    const PairList& list = objects_.list();
    for_each_particle(list, fresh_, [&](std::span<const Index> places) {
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

void WallContacts::add_forces(ParticleState& particles,
                              const WallBody& wall,
                              const ContactTable& table,
                              double timestep,
                              bool records,
                              const Kernels& kernels) {
    const Index count = touching_count();
    if (records) {
        records_.resize(std::size_t{count} * record_size);
    }
    force_.resize(4 * std::size_t{count});
    const WallVelocity& velocity = wall.velocity();
    const Vec3& centre = wall.rotation_centre();
    kernels.wall_pass({.particles = particles.view(),
                       .laws = table.view(timestep),
                       .particle = objects_.list().i.data(),
                       .touching = objects_.touching().data(),
                       .touching_count = count,
                       .velocity = {velocity.linear.x, velocity.linear.y, velocity.linear.z},
                       .spin = {velocity.angular.x, velocity.angular.y, velocity.angular.z},
                       .centre = {centre.x, centre.y, centre.z},
                       .material = static_cast<double>(wall.material()),
                       .rows = objects_.rows(),
                       .force = force_.data(),
                       .records = records ? records_.data() : nullptr});
}

void WallContacts::add_steps(ParticleState& particles,
                             const WallBody& wall,
                             const ContactTable& table,
                             bool touching_only,
                             const StepSums& sums,
                             const Kernels& kernels) {
    if (touching_only) {
        hits_.clear();
        for (Index t = 0; t < touching_count(); ++t) {
            hits_.push_back({place(t), normal(t), distance(t)});
        }
    } else {
        clock_.look_ahead(particles.smallest_radius());
        // Against a wall only the particle travels, relative to it: once the horizon, not twice.
        find_hits(particles, wall, clock_.horizon(), kernels);
    }
    step_particle_.clear();
    step_geometry_.clear();
    for (const Hit& hit : hits_) {
        step_particle_.push_back(objects_.list().i[hit.place]);
        step_geometry_.insert(step_geometry_.end(),
                              {hit.normal.x, hit.normal.y, hit.normal.z, hit.distance});
    }
    kernels.add_wall_steps({.particles = particles.view(),
                            .laws = table.view(0.0),
                            .particle = step_particle_.data(),
                            .geometry = step_geometry_.data(),
                            .count = static_cast<Index>(step_particle_.size()),
                            .material = static_cast<double>(wall.material()),
                            .sums = sums});
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

void WallContacts::save(Archive& archive, const std::string& name) const {
    clock_.save(archive, name);
    archive.put(
        name + "/candidate_particle",
        std::vector<Index>(candidates_.i.begin(), candidates_.i.begin() + candidates_.count));
    archive.put(
        name + "/candidate_patch",
        std::vector<Index>(candidates_.j.begin(), candidates_.j.begin() + candidates_.count));
    objects_.save(archive, name + "/objects");
    archive.put(name + "/force", std::vector<double>(force_.begin(), force_.end()));
    archive.put(name + "/records", std::vector<double>(records_.begin(), records_.end()));
    archive.put(name + "/late", late_);
}

void WallContacts::load(const Archive& archive, const std::string& name) {
    clock_.load(archive, name);
    const auto& particle = archive.get<Index>(name + "/candidate_particle");
    const auto& patch = archive.get<Index>(name + "/candidate_patch");
    candidates_.i.assign(particle.begin(), particle.end());
    candidates_.j.assign(patch.begin(), patch.end());
    candidates_.count = static_cast<Index>(particle.size());
    candidates_.pad();
    objects_.load(archive, name + "/objects");
    const auto& force = archive.get<double>(name + "/force");
    force_.assign(force.begin(), force.end());
    const auto& records = archive.get<double>(name + "/records");
    records_.assign(records.begin(), records.end());
    late_ = archive.count(name + "/late");
}

}  // namespace grainbench
