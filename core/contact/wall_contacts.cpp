#include "core/contact/wall_contacts.hpp"

#include <algorithm>

namespace grainbench {

namespace {

/// Calls visit(particle, first, last) for each run of entries of one particle.
template <class Particle, class Visit>
void for_each_particle(Index count, Particle&& particle, Visit&& visit) {
    for (Index first = 0; first < count;) {
        Index last = first + 1;
        while (last < count && particle(last) == particle(first)) {
            ++last;
        }
        visit(particle(first), first, last);
        first = last;
    }
}

ClosePatches close_patches(const ParticleState& particles,
                           const WallBody& wall,
                           const PairList& list,
                           double scale,
                           double extra,
                           Index* found) {
    ClosePatches query{
        .position = particles.positions().data(),
        .planes = wall.surface().bounding_planes().data(),
        .particle = list.i.data(),
        .patch = list.j.data(),
        .count = list.count,
        .shift = {wall.displacement().x, wall.displacement().y, wall.displacement().z},
        .rotation = {},
        .centre = {},
        .rotated = wall.is_turned(),
        .scale = scale,
        .extra = extra,
        .found = found};
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            query.rotation[3 * row + column] = wall.rotation()[3 * column + row];
        }
    }
    return query;
}

template <class T>
std::vector<T> plain(const Column<T>& column) {
    return {column.begin(), column.end()};
}

/// The first `count` rows of `width` columns of `stride`. Rows past them are left over from earlier
/// steps and are no part of the state.
template <class T>
std::vector<T> rows(const Column<T>& columns, std::size_t width, std::size_t stride, Index count) {
    std::vector<T> result;
    for (std::size_t c = 0; c < width; ++c) {
        const auto first = columns.begin() + static_cast<std::ptrdiff_t>(c * stride);
        result.insert(result.end(), first, first + count);
    }
    return result;
}

}  // namespace

WallContacts::WallContacts(const SearchSettings& settings, int history_size)
    : settings_(settings), history_size_(history_size) {}

void WallContacts::change_history(std::span<const int> sources) {
    const Column<double> old = std::move(history_);
    history_size_ = static_cast<int>(sources.size());
    history_.assign(stride_ * sources.size(), 0.0);
    for (std::size_t c = 0; c < sources.size(); ++c) {
        if (sources[c] >= 0) {
            const auto from = static_cast<std::size_t>(sources[c]) * stride_;
            std::copy_n(old.begin() + static_cast<std::ptrdiff_t>(from),
                        stride_,
                        history_.begin() + static_cast<std::ptrdiff_t>(c * stride_));
        }
    }
}

void WallContacts::add_travel(double bound) {
    near_clock_.add(bound);
    candidate_clock_.add(bound);
    soon_travel_ += bound;
    last_travel_ = bound;
}

bool WallContacts::is_due(std::uint64_t cycle,
                          const ParticleState& particles,
                          const WallBody& wall) {
    if (!started_) {
        return true;
    }
    if (settings_.brute_force) {
        return false;
    }
    if (settings_.interval > 0) {
        return cycle >= last_cycle_ + static_cast<std::uint64_t>(settings_.interval);
    }
    return near_clock_.expired(settings_.near_travel(soon_limit_, particles.smallest_radius()),
                               particles,
                               wall.displacement(),
                               !wall.is_turned());
}

Renewal WallContacts::update(std::uint64_t cycle,
                             const ParticleState& particles,
                             const WallBody& wall,
                             const Kernels& kernels) {
    if (is_due(cycle, particles, wall)) {
        if (!started_ || candidate_clock_.expired(
                             settings_.slack, particles, wall.displacement(), !wall.is_turned())) {
            build_candidates(particles, wall);
        }
        renew(particles, wall, kernels);
        renew_soon(particles, wall, kernels);
        near_clock_.restart(particles, wall.displacement());
        last_cycle_ = cycle;
        just_renewed_ = started_;
        started_ = true;
        return Renewal::objects;
    }
    if (soon_travel_ > soon_limit_ && !settings_.brute_force) {
        renew_soon(particles, wall, kernels);
        return Renewal::soon;
    }
    return Renewal::none;
}

void WallContacts::build_candidates(const ParticleState& particles, const WallBody& wall) {
    candidates_.clear();
    std::vector<Index> patches;
    for (Index slot = 0; slot < particles.size(); ++slot) {
        patches.clear();
        const double reach =
            settings_.brute_force
                ? 1e300
                : (1.0 + settings_.tolerance) * particles.radius(slot) + settings_.slack;
        wall.surface().collect(wall.to_wall(particles.position(slot)), reach, patches);
        for (const Index patch : patches) {
            candidates_.append(slot, patch);
        }
    }
    candidates_.pad();
    candidate_clock_.restart(particles, wall.displacement());
}

void WallContacts::renew(const ParticleState& particles,
                         const WallBody& wall,
                         const Kernels& kernels) {
    const PairList old_near = std::move(near_);
    Column<Index> found(static_cast<std::size_t>(candidates_.count) + 8);
    const double scale = settings_.brute_force ? 1e300 : 1.0 + settings_.tolerance;
    const Index count =
        kernels.find_patches(close_patches(particles, wall, candidates_, scale, 0.0, found.data()));
    near_ = {};
    fresh_.clear();
    Index old = 0;
    for (Index k = 0; k < count; ++k) {
        const Index particle = candidates_.i[found[k]];
        const Index patch = candidates_.j[found[k]];
        while (old < old_near.count &&
               std::pair(old_near.i[old], old_near.j[old]) < std::pair(particle, patch)) {
            ++old;
        }
        const bool known =
            old < old_near.count && old_near.i[old] == particle && old_near.j[old] == patch;
        near_.append(particle, patch);
        fresh_.push_back(known ? 0 : 1);
    }
    near_.pad();
    object_count_ = 0;
    WallHits hits;
    for_each_particle(
        near_.count,
        [&](Index k) { return near_.i[k]; },
        [&](Index particle, Index first, Index last) {
            const double reach = (1.0 + settings_.tolerance) * particles.radius(particle);
            wall.surface().resolve(wall.to_wall(particles.position(particle)),
                                   reach,
                                   {near_.j.data() + first, last - first},
                                   hits);
            object_count_ += static_cast<Index>(hits.count);
        });
}

void WallContacts::renew_soon(const ParticleState& particles,
                              const WallBody& wall,
                              const Kernels& kernels) {
    soon_limit_ = settings_.soon_travel(last_travel_, particles.smallest_radius());
    soon_travel_ = 0.0;
    // Against a wall only the particle travels, relative to it: once the limit, not twice.
    const double extra = settings_.brute_force ? 1e300 : soon_limit_;
    found_.resize(near_.i.size());
    const Index count =
        kernels.find_patches(close_patches(particles, wall, near_, 1.0, extra, found_.data()));
    soon_.clear();
    soon_place_.assign(found_.begin(), found_.begin() + count);
    for (Index k = 0; k < count; ++k) {
        soon_.append(near_.i[found_[k]], near_.j[found_[k]]);
    }
    soon_.pad();
    soon_objects_.clear();
    WallHits hits;
    for_each_particle(
        soon_.count,
        [&](Index k) { return soon_.i[k]; },
        [&](Index particle, Index first, Index last) {
            wall.surface().resolve(wall.to_wall(particles.position(particle)),
                                   particles.radius(particle) + soon_limit_,
                                   {soon_.j.data() + first, last - first},
                                   hits);
            for (const WallHit& hit : hits.view()) {
                soon_objects_.push_back({particle, wall.direction_to_space(hit.normal)});
            }
        });
}

void WallContacts::reserve(std::size_t contacts) {
    if (contacts <= stride_) {
        return;
    }
    const std::size_t wanted = contacts + contacts / 2 + 16;
    const auto widen = [&](Column<double>& columns, std::size_t width) {
        Column<double> wider(wanted * width, 0.0);
        for (std::size_t c = 0; c < width && stride_ > 0; ++c) {
            std::copy_n(columns.begin() + static_cast<std::ptrdiff_t>(c * stride_),
                        stride_,
                        wider.begin() + static_cast<std::ptrdiff_t>(c * wanted));
        }
        columns = std::move(wider);
    };
    widen(normal_, 3);
    widen(distance_, 1);
    widen(wall_velocity_, 3);
    widen(wall_spin_, 1);
    widen(entered_, 1);
    widen(history_, static_cast<std::size_t>(history_size_));
    widen(force_, 3);
    particle_.resize(wanted);
    patch_.resize(wanted);
    stride_ = wanted;
}

bool WallContacts::find_touching(const ParticleState& particles,
                                 const WallBody& wall,
                                 const Kernels& kernels) {
    std::swap(particle_, particle_before_);
    std::swap(patch_, patch_before_);
    std::swap(normal_, normal_before_);
    std::swap(history_, history_before_);
    count_before_ = count_;
    stride_before_ = stride_;
    particle_.resize(stride_);
    patch_.resize(stride_);
    normal_.resize(3 * stride_);
    history_.resize(stride_ * static_cast<std::size_t>(history_size_));
    taken_.assign(count_before_, 0);
    count_ = 0;

    found_.resize(soon_.i.size());
    const Index found = kernels.find_patches(close_patches(
        particles, wall, soon_, 1.0, settings_.brute_force ? 1e300 : 0.0, found_.data()));
    bool changed = false;
    Index before = 0;
    std::vector<Index> patches;
    WallHits hits;
    for_each_particle(
        found,
        [&](Index k) { return soon_.i[found_[k]]; },
        [&](Index particle, Index first, Index last) {
            patches.clear();
            bool all_fresh = true;
            for (Index k = first; k < last; ++k) {
                patches.push_back(soon_.j[found_[k]]);
                all_fresh = all_fresh && fresh_[soon_place_[found_[k]]] != 0;
            }
            wall.surface().resolve(wall.to_wall(particles.position(particle)),
                                   particles.radius(particle),
                                   patches,
                                   hits);
            const Index first_new = count_;
            changed = add_hits(particles, wall, particle, hits.view(), before) || changed;
            if (all_fresh && just_renewed_) {
                // Near only since this renewal and overlapping already: found late.
                for (Index t = first_new; t < count_; ++t) {
                    late_ += entered_[t] == 0.0 ? 1 : 0;
                    entered_[t] = 1.0;
                }
            }
        });
    just_renewed_ = false;
    return changed || count_ != count_before_;
}

bool WallContacts::add_hits(const ParticleState& particles,
                            const WallBody& wall,
                            Index particle,
                            std::span<const WallHit> hits,
                            Index& before) {
    while (before < count_before_ && particle_before_[before] < particle) {
        ++before;
    }
    Index last_before = before;
    while (last_before < count_before_ && particle_before_[last_before] == particle) {
        ++last_before;
    }
    reserve(count_ + hits.size());
    const Index first_new = count_;
    for (const WallHit& hit : hits) {
        const Index t = count_++;
        const Vec3 normal = wall.direction_to_space(hit.normal);
        const double radius = particles.radius(particle);
        // Contact point in the middle of the overlap (physics reference 1.1).
        const Vec3 at = particles.position(particle) + 0.5 * (radius + hit.distance) * normal;
        const Vec3 velocity = wall.velocity_at(at);
        particle_[t] = particle;
        patch_[t] = hit.patch;
        distance_[t] = hit.distance;
        wall_spin_[t] = dot(wall.velocity().angular, normal);
        const double parts[6] = {normal.x, normal.y, normal.z, velocity.x, velocity.y, velocity.z};
        for (std::size_t c = 0; c < 3; ++c) {
            normal_[c * stride_ + t] = parts[c];
            wall_velocity_[c * stride_ + t] = parts[c + 3];
        }
    }
    bool changed = last_before - before != hits.size();
    hand_over(wall.surface(), first_new, before, last_before);
    for (Index t = first_new; t < count_; ++t) {
        changed = changed || entered_[t] == 0.0;
    }
    before = last_before;
    return changed;
}

void WallContacts::hand_over(const Surface& surface,
                             Index first_new,
                             Index first_before,
                             Index last_before) {
    for (Index t = first_new; t < count_; ++t) {
        entered_[t] = 0.0;
        for (std::size_t h = 0; h < static_cast<std::size_t>(history_size_); ++h) {
            history_[h * stride_ + t] = 0.0;
        }
        for (Index b = first_before; b < last_before; ++b) {
            if (taken_[b] == 0 && patch_before_[b] == patch_[t]) {
                take_history(t, b);
                break;
            }
        }
    }
    // What a patch has lost goes to a neighbour that goes on in its place, nearest direction first.
    // A face that is met while another is left must start from nothing.
    constexpr double smallest_cosine = 0.5;
    for (bool found = true; found;) {
        found = false;
        double best = smallest_cosine;
        std::pair<Index, Index> best_pair;
        for (Index t = first_new; t < count_; ++t) {
            for (Index b = first_before; b < last_before; ++b) {
                const Vec3 old{normal_before_[b],
                               normal_before_[stride_before_ + b],
                               normal_before_[2 * stride_before_ + b]};
                if (entered_[t] == 0.0 && taken_[b] == 0 && dot(normal(t), old) > best &&
                    surface.adjacent(patch_before_[b], patch_[t])) {
                    best = dot(normal(t), old);
                    best_pair = {t, b};
                    found = true;
                }
            }
        }
        if (found) {
            take_history(best_pair.first, best_pair.second);
        }
    }
}

void WallContacts::take_history(Index t, Index before) {
    entered_[t] = 1.0;
    taken_[before] = 1;
    for (std::size_t h = 0; h < static_cast<std::size_t>(history_size_); ++h) {
        history_[h * stride_ + t] = history_before_[h * stride_before_ + before];
    }
}

void WallContacts::add_forces(ParticleState& particles,
                              const WallBody& wall,
                              const ContactTable& table,
                              double timestep,
                              bool records,
                              const Kernels& kernels) {
    if (records) {
        records_.resize(static_cast<std::size_t>(count_) * record_size);
    }
    kernels.wall_pass(table.combination(),
                      records,
                      {.particles = particles.view(),
                       .laws = table.view(timestep),
                       .count = count_,
                       .stride = stride_,
                       .particle = particle_.data(),
                       .normal = normal_.data(),
                       .distance = distance_.data(),
                       .wall_velocity = wall_velocity_.data(),
                       .wall_spin = wall_spin_.data(),
                       .entered = entered_.data(),
                       .material = static_cast<double>(wall.material()),
                       .history_in = history_.data(),
                       .history_out = history_.data(),
                       .force = force_.data(),
                       .records = records_.data()});
}

Vec3 WallContacts::point(const ParticleState& particles, Index t) const {
    return particles.position(particle_[t]) + distance_[t] * normal(t);
}

void WallContacts::save(Archive& archive, const std::string& name) const {
    near_clock_.save(archive, name + "/near_clock");
    candidate_clock_.save(archive, name + "/candidate_clock");
    const auto put_list = [&](const PairList& list, const std::string& list_name) {
        archive.put(name + "/" + list_name + "_particle",
                    std::vector<Index>(list.i.begin(), list.i.begin() + list.count));
        archive.put(name + "/" + list_name + "_patch",
                    std::vector<Index>(list.j.begin(), list.j.begin() + list.count));
    };
    put_list(candidates_, "candidate");
    put_list(near_, "near");
    archive.put(name + "/fresh", fresh_);
    put_list(soon_, "soon");
    archive.put(name + "/soon_place", plain(soon_place_));
    archive.put(name + "/soon_clock", std::vector<double>{last_travel_, soon_travel_, soon_limit_});
    std::vector<Index> object_particles;
    std::vector<double> object_normals;
    for (const WallObject& object : soon_objects_) {
        object_particles.push_back(object.particle);
        object_normals.insert(object_normals.end(),
                              {object.normal.x, object.normal.y, object.normal.z});
    }
    archive.put(name + "/object_particle", object_particles);
    archive.put(name + "/object_normal", object_normals);
    const auto put_rows = [&](const auto& columns, std::size_t width, const char* column_name) {
        archive.put(name + "/" + column_name, rows(columns, width, stride_, count_));
    };
    put_rows(particle_, 1, "particle");
    put_rows(patch_, 1, "patch");
    put_rows(normal_, 3, "normal");
    put_rows(distance_, 1, "distance");
    put_rows(wall_velocity_, 3, "wall_velocity");
    put_rows(wall_spin_, 1, "wall_spin");
    put_rows(entered_, 1, "entered");
    put_rows(history_, static_cast<std::size_t>(history_size_), "history");
    put_rows(force_, 3, "force");
    archive.put(name + "/records", plain(records_));
    archive.put(
        name + "/counters",
        std::vector<std::uint64_t>{
            count_, last_cycle_, late_, object_count_, static_cast<std::uint64_t>(just_renewed_)});
}

void WallContacts::load(const Archive& archive, const std::string& name) {
    near_clock_.load(archive, name + "/near_clock");
    candidate_clock_.load(archive, name + "/candidate_clock");
    const auto get_list = [&](PairList& list, const std::string& list_name) {
        const auto& particle = archive.get<Index>(name + "/" + list_name + "_particle");
        const auto& patch = archive.get<Index>(name + "/" + list_name + "_patch");
        list.i.assign(particle.begin(), particle.end());
        list.j.assign(patch.begin(), patch.end());
        list.count = static_cast<Index>(particle.size());
        list.pad();
    };
    get_list(candidates_, "candidate");
    get_list(near_, "near");
    fresh_ = archive.get<std::uint8_t>(name + "/fresh");
    get_list(soon_, "soon");
    const auto& clock = archive.get<double>(name + "/soon_clock");
    last_travel_ = clock.at(0);
    soon_travel_ = clock.at(1);
    soon_limit_ = clock.at(2);
    const auto& object_particles = archive.get<Index>(name + "/object_particle");
    const auto& object_normals = archive.get<double>(name + "/object_normal");
    soon_objects_.clear();
    for (std::size_t k = 0; k < object_particles.size(); ++k) {
        soon_objects_.push_back({object_particles[k],
                                 {object_normals.at(3 * k),
                                  object_normals.at(3 * k + 1),
                                  object_normals.at(3 * k + 2)}});
    }
    const auto get = [&](Column<double>& column, const std::string& column_name) {
        const auto& from = archive.get<double>(name + "/" + column_name);
        column.assign(from.begin(), from.end());
    };
    const auto get_index = [&](Column<Index>& column, const std::string& column_name) {
        const auto& from = archive.get<Index>(name + "/" + column_name);
        column.assign(from.begin(), from.end());
    };
    get_index(soon_place_, "soon_place");
    get_index(particle_, "particle");
    get_index(patch_, "patch");
    get(normal_, "normal");
    get(distance_, "distance");
    get(wall_velocity_, "wall_velocity");
    get(wall_spin_, "wall_spin");
    get(entered_, "entered");
    get(history_, "history");
    get(force_, "force");
    get(records_, "records");
    const auto& counters = archive.get<std::uint64_t>(name + "/counters");
    count_ = static_cast<Index>(counters.at(0));
    stride_ = count_;
    last_cycle_ = counters.at(1);
    late_ = counters.at(2);
    object_count_ = static_cast<Index>(counters.at(3));
    just_renewed_ = counters.at(4) != 0;
    started_ = true;
}

}  // namespace grainbench
