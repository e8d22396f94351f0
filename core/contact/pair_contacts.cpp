#include "core/contact/pair_contacts.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

namespace grainbench {

namespace {

/// Words of objects in a part of the near pairs: enough work to be worth a thread.
constexpr std::size_t near_part_words = 128;

/// A record as it would be had i and j changed places.
void turn_record(double* record) {
    for (const Index first : {record_damping_x, record_shear_x, record_normal_x, record_moment_x}) {
        for (Index c = first; c < first + 3; ++c) {
            record[c] = -record[c];
        }
    }
    std::swap(record[record_lever_i], record[record_lever_j]);
}

}  // namespace

PairContacts::PairContacts(const SearchSettings& settings, int history_size)
    : clock_(settings), objects_(history_size) {}

PairQuery PairContacts::query(const ParticleState& particles,
                              const PairList& list,
                              double scale,
                              double extra) const {
    return {.position = particles.positions().data(),
            .i = list.i.data(),
            .j = list.j.data(),
            .count = list.count,
            .scale = scale,
            .extra = extra};
}

Renewal PairContacts::due(std::uint64_t cycle,
                          const ParticleState& particles,
                          const Vec3& bed_shift,
                          const Kernels& kernels) {
    return clock_.due(cycle, particles, bed_shift, true, kernels);
}

void PairContacts::renew(Renewal due,
                         std::uint64_t cycle,
                         const ParticleState& particles,
                         const Vec3& bed_shift,
                         const Kernels& kernels) {
    if (due == Renewal::candidates) {
        build_candidates(particles, kernels);
    }
    if (due <= Renewal::objects) {
        renew_objects(particles, kernels);
        clock_.renewed(due, cycle, particles, bed_shift);
    }
}

double PairContacts::candidate_reach(const ParticleState& particles) const {
    const SearchSettings& settings = clock_.settings();
    return 2.0 * ((1.0 + settings.tolerance) * particles.largest_radius() + settings.slack);
}

void PairContacts::change_population(const PopulationChange& change,
                                     const ParticleState& after,
                                     const ContactTable& table) {
    const bool has_records = has_all_records();
    const Renumbered touching = objects_.renumber(change, true, table.turned_columns());
    if (has_records) {
        pick_rows(records_, touching.touching_before, record_size);
        for (std::size_t t = 0; t < touching.turned.size(); ++t) {
            if (touching.turned[t]) {
                turn_record(records_.data() + t * record_size);
            }
        }
    } else {
        records_.clear();
    }
    candidates_.clear();
    candidates_.pad();
    within_.resize(objects_.list().words());
    near_is_ahead_ = false;
    cut_into_slabs(after);
    clock_.expire(after);
}

double PairContacts::mean_slot_distance() const {
    double sum = 0.0;
    for (Index k = 0; k < objects_.list().count; ++k) {
        sum += static_cast<double>(objects_.list().j[k] - objects_.list().i[k]);
    }
    return sum / std::max<double>(objects_.list().count, 1.0);
}

void PairContacts::build_candidates(const ParticleState& particles, const Kernels& kernels) {
    const SearchSettings& settings = clock_.settings();
    if (settings.brute_force) {
        candidates_.clear();
        for (Index a = 0; a < particles.size(); ++a) {
            for (Index b = a + 1; b < particles.row_count(); ++b) {
                candidates_.append(a, b);
            }
        }
        candidates_.pad();
    } else {
        finder_.find(
            particles, 1.0 + settings.tolerance, 2.0 * settings.slack, kernels, candidates_);
    }
    if (particles.has_images()) {
        leave_one_of_images(particles);
    }
    if (particles.has_driven()) {
        candidates_.remove_if(
            [&](Index i, Index j) { return particles.is_driven(i) && particles.is_driven(j); });
    }
    ++builds_;
}

/// Two particles near a periodic boundary meet twice, each with the image of the other: the pair of
/// the lower slot and the image of the higher stays. Pairs then ascend by the particles they mean.
void PairContacts::leave_one_of_images(const ParticleState& particles) {
    candidates_.remove_if(
        [&](Index i, Index j) { return i >= particles.size() || i >= particles.owner(j); });
    for (Index first = 0; first < candidates_.count;) {
        Index last = first;
        while (last < candidates_.count && candidates_.i[last] == candidates_.i[first]) {
            ++last;
        }
        std::sort(candidates_.j.begin() + first,
                  candidates_.j.begin() + last,
                  [&](Index a, Index b) { return particles.owner(a) < particles.owner(b); });
        first = last;
    }
}

void PairContacts::renew_objects(const ParticleState& particles, const Kernels& kernels) {
    found_.resize(static_cast<std::size_t>(candidates_.count) + 8);
    Index count = candidates_.count;
    if (clock_.settings().brute_force) {
        std::iota(found_.begin(), found_.end(), Index{0});
    } else {
        count = kernels.find_pairs(
            query(particles, candidates_, 1.0 + clock_.settings().tolerance, 0.0), found_.data());
    }
    objects_.renew(candidates_, {found_.data(), count}, RowOwners(particles));
    within_.resize(objects_.list().words());
    near_is_ahead_ = false;
    cut_into_slabs(particles);
    just_renewed_ = true;
    ++renewals_;
}

/// One slab in small scenes, and where particles have wandered so far that some contact reaches
/// past the next slab.
void PairContacts::cut_into_slabs(const ParticleState& particles) {
    const PairList& list = objects_.list();
    const Index size = particles.slab_size();
    slab_start_.assign(1, 0);
    bool fits = particles.slab_count() > 1;
    for (Index k = 0; k < list.count && fits; ++k) {
        const Index slab = list.i[k] / size;
        while (slab_start_.size() <= slab) {
            slab_start_.push_back(k);
        }
        fits = list.j[k] / size <= slab + 1;
    }
    slab_start_.resize(fits ? slab_start_.size() : 1);
    slab_start_.push_back(list.count);
}

/// Born overlapping: the whole of the first step counts (physics reference 1.3).
void PairContacts::adopt_late_contacts(const ParticleState& particles) {
    const PairList& list = objects_.list();
    for (std::size_t w = 0; w < within_.size(); ++w) {
        for_each_bit(within_[w] & ~objects_.acting()[w], 64 * w, [&](Index k) {
            if (!objects_.was_listed(list.i[k], particles.owner(list.j[k]))) {
                objects_.set_acting(k);
                late_ += renewals_ > 1 ? 1 : 0;
            }
        });
    }
    objects_.forget_before();
    just_renewed_ = false;
}

void PairContacts::test(const ParticleState& particles,
                        double reach,
                        bool looks_ahead,
                        const Kernels& kernels,
                        const Workers& workers) {
    constexpr Index part_size = 8192;  // pairs, a multiple of 64
    const bool near_only = !looks_ahead && near_is_all(reach);
    const PairQuery all = query(particles, near_only ? near_ : objects_.list(), 1.0, reach);
    std::vector<std::uint64_t>& within = near_only ? within_near_ : within_;
    double ahead = 0.0;
    if (looks_ahead) {
        clock_.look_ahead(particles.smallest_radius());
        ahead = clock_.settings().brute_force ? 1e300 : 2.0 * clock_.horizon();
        ahead_.resize(within_.size());
    }
    workers.for_each((all.count + part_size - 1) / part_size, [&](std::size_t part) {
        const auto first = static_cast<Index>(part * part_size);
        PairQuery of_part = all;
        of_part.i += first;
        of_part.j += first;
        of_part.count = std::min(part_size, all.count - first);
        std::uint64_t* const words = within.data() + first / 64;
        if (looks_ahead) {
            kernels.test_pairs_ahead(of_part, ahead, words, ahead_.data() + first / 64);
        } else {
            kernels.test_pairs(of_part, words);
        }
    });
    if (looks_ahead) {
        list_near(ahead_, workers);
        near_is_ahead_ = true;
        ahead_reach_ = reach;
    } else if (near_only) {
        for_each_near_part(workers, [&](const NearPart& part) {
            std::fill(within_.data() + part.first_word, within_.data() + part.last_word, 0);
            for_each_bit(within_near_, part.first, part.first + part.count, [&](Index k) {
                within_[near_place_[k] / 64] |= std::uint64_t{1} << (near_place_[k] % 64);
            });
        });
    }
}

void PairContacts::list_near(std::span<const std::uint64_t> words, const Workers& workers) {
    near_parts_.resize((words.size() + near_part_words - 1) / near_part_words);
    for (std::size_t p = 0; p < near_parts_.size(); ++p) {
        near_parts_[p].first_word = p * near_part_words;
        near_parts_[p].last_word = std::min((p + 1) * near_part_words, words.size());
    }
    for_each_near_part(workers, [&](NearPart& part) {
        part.count = 0;
        for (std::size_t w = part.first_word; w < part.last_word; ++w) {
            part.count += static_cast<Index>(std::popcount(words[w]));
        }
    });
    near_.count = 0;
    for (NearPart& part : near_parts_) {
        part.first = near_.count;
        near_.count += part.count;
    }
    near_.pad();
    near_place_.resize(near_.count);
    within_near_.resize(near_.words());
    const PairList& list = objects_.list();
    for_each_near_part(workers, [&](const NearPart& part) {
        Index k = part.first;
        const auto first = static_cast<Index>(64 * part.first_word);
        const auto last = static_cast<Index>(64 * part.last_word);
        for_each_bit(words, first, last, [&](Index place) {
            near_place_[k] = place;
            near_.i[k] = list.i[place];
            near_.j[k++] = list.j[place];
        });
    });
    near_is_ahead_ = false;
}

bool PairContacts::near_is_all(double reach) const {
    // What touches must be put in its places afterwards: about as dear as a test.
    return near_is_ahead_ && reach == ahead_reach_ && clock_.is_within_horizon() &&
           near_.count + touching().size() < objects_.list().count;
}

bool PairContacts::find_touching(const ParticleState& particles,
                                 double reach,
                                 bool looks_ahead,
                                 const Kernels& kernels,
                                 const Workers& workers) {
    if (just_renewed_ && reach > 0.0) {
        test(particles, 0.0, false, kernels, workers);
        adopt_late_contacts(particles);
    }
    test(particles, reach, looks_ahead, kernels, workers);
    if (just_renewed_) {
        adopt_late_contacts(particles);
    }
    return objects_.set_touching(within_, workers);
}

/// Every other slab at a time, since contacts of one reach into the next.
template <class Act>
void PairContacts::for_each_slab(const Workers& workers, const Act& act) const {
    const std::size_t slabs = slab_start_.size() - 1;
    for (const std::size_t parity : {0U, 1U}) {
        workers.for_each((slabs + 1 - parity) / 2,
                         [&](std::size_t part) { act(2 * part + parity); });
    }
}

std::size_t PairContacts::first_touching(std::size_t slab) const {
    const auto first =
        std::partition_point(touching().begin(), touching().end(), [&](TouchingContact contact) {
            return contact.place() < slab_start_[slab];
        });
    return static_cast<std::size_t>(first - touching().begin());
}

Index PairContacts::first_near(std::size_t slab) const {
    const auto first = std::partition_point(near_place_.begin(),
                                            near_place_.end(),
                                            [&](Index place) { return place < slab_start_[slab]; });
    return static_cast<Index>(first - near_place_.begin());
}

void PairContacts::add_forces(ParticleState& particles,
                              const ContactTable& table,
                              double timestep,
                              bool records,
                              const Kernels& kernels,
                              const Workers& workers) {
    if (records) {
        records_.resize(touching().size() * record_size);
    } else {
        release_if_large(records_);
    }
    // Where most particles touch something, marking them contact by contact costs more than it
    // saves (Engine::few_are_loaded).
    const bool many_touch = 4 * touching().size() >= particles.size();
    if (many_touch) {
        particles.mark_all_loaded();
    }
    const PairPass all{.particles = particles.view(),
                       .laws = table.view(timestep),
                       .i = objects().i.data(),
                       .j = objects().j.data(),
                       .touching = touching().data(),
                       .touching_count = static_cast<Index>(touching().size()),
                       .marks_loaded = !many_touch,
                       .rows = objects_.rows(),
                       .records = records ? records_.data() : nullptr};
    for_each_slab(workers, [&](std::size_t slab) {
        const std::size_t first = first_touching(slab);
        PairPass pass = all;
        pass.touching += first;
        pass.touching_count = static_cast<Index>(first_touching(slab + 1) - first);
        if (records) {
            pass.records += first * record_size;
        }
        kernels.pair_pass(pass);
    });
}

void PairContacts::add_steps(ParticleState& particles,
                             const ContactTable& table,
                             bool touching_only,
                             const StepSums& sums,
                             const Kernels& kernels,
                             const Workers& workers) {
    if (touching_only) {
        list_near(objects_.acting(), workers);
    }
    const PairStepPass all{.particles = particles.view(),
                           .laws = table.view(0.0),
                           .i = near_.i.data(),
                           .j = near_.j.data(),
                           .count = 0,
                           .sums = sums};
    for_each_slab(workers, [&](std::size_t slab) {
        const Index first = first_near(slab);
        PairStepPass pass = all;
        pass.i += first;
        pass.j += first;
        pass.count = first_near(slab + 1) - first;
        kernels.add_pair_steps(pass);
    });
}

void PairContacts::save(Archive& archive, bool records) const {
    clock_.save(archive, "pairs");
    archive.put(
        "pairs/candidate_i",
        std::vector<Index>(candidates_.i.begin(), candidates_.i.begin() + candidates_.count));
    archive.put(
        "pairs/candidate_j",
        std::vector<Index>(candidates_.j.begin(), candidates_.j.begin() + candidates_.count));
    objects_.save(archive, "pairs/objects");
    archive.put(
        "pairs/records",
        records ? std::vector<double>(records_.begin(), records_.end()) : std::vector<double>());
    archive.put("pairs/counters", std::vector<std::uint64_t>{late_, renewals_, builds_});
}

void PairContacts::load(const Archive& archive, const ParticleState& particles) {
    const std::size_t size = particles.size();
    clock_.load(archive, "pairs", particles);
    const std::size_t rows = particles.row_count();
    const RowOwners owner(particles);
    candidates_.load(archive, "pairs/candidate_i", "pairs/candidate_j", size, rows, owner);
    objects_.load(archive, "pairs/objects", size, rows, owner);
    within_.assign(objects_.list().words(), 0);
    near_is_ahead_ = false;
    cut_into_slabs(particles);
    const auto& records = archive.get<double>("pairs/records");
    records_.assign(records.begin(), records.end());
    const auto& counters = archive.get<std::uint64_t>("pairs/counters", 3);
    late_ = counters[0];
    renewals_ = counters[1];
    builds_ = counters[2];
}

}  // namespace grainbench
