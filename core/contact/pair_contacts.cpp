#include "core/contact/pair_contacts.hpp"

#include <algorithm>
#include <bit>

namespace grainbench {

namespace {

/// A reach that holds all pairs, and whose square is a number.
constexpr double everywhere = 1e150;

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

Renewal PairContacts::due(std::uint64_t cycle,
                          bool looks_ahead,
                          const ParticleState& particles,
                          const Vec3& bed_shift,
                          const Kernels& kernels) {
    return clock_.due(cycle, looks_ahead, particles, bed_shift, true, kernels);
}

void PairContacts::renew(Renewal due,
                         std::uint64_t cycle,
                         const ParticleState& particles,
                         const Vec3& bed_shift,
                         const Kernels& kernels) {
    if (due <= Renewal::objects) {
        clock_.choose_reach(due, particles.smallest_radius());
    }
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
    const double widest = std::max(settings.tolerance, settings.widest);
    const double slack = std::max(settings.slack, settings.widest_slack);
    return 2.0 * ((1.0 + widest) * particles.largest_radius() + slack);
}

void PairContacts::change_population(const PopulationChange& change,
                                     const ParticleState& after,
                                     const ContactTable& table) {
    const std::size_t count_before = touching().size();
    const Renumbered renumbered = objects_.renumber(change, true, table.turned_columns());
    records_.renumber(renumbered, count_before, turn_record);
    candidates_.clear();
    candidates_.pad();
    touch_.forget(objects_.list());
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
        finder_.find(particles,
                     1.0 + clock_.candidate_reach(),
                     2.0 * clock_.candidate_slack(),
                     kernels,
                     candidates_);
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
    const double scale = clock_.settings().brute_force ? everywhere : 1.0 + clock_.object_reach();
    within_.resize(candidates_.words());
    kernels.test_pairs(query_of(particles, candidates_, scale, 0.0), within_.data());
    objects_.renew(candidates_, within_, kernels, RowOwners(particles));
    release_if_large(within_);
    touch_.forget(objects_.list());
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
    const auto within = touch_.bits();
    for (std::size_t w = 0; w < within.size(); ++w) {
        for_each_bit(within[w] & ~objects_.acting()[w], 64 * w, [&](Index k) {
            if (!objects_.was_listed(list.i[k], particles.owner(list.j[k]))) {
                objects_.set_acting(k);
                late_ += renewals_ > 1 ? 1 : 0;
            }
        });
    }
    objects_.forget_before();
    just_renewed_ = false;
}

void PairContacts::add_travel(double bound, double fall) {
    clock_.add_travel(bound, fall);
    touch_.add_travel(bound);
}

bool PairContacts::test(const ParticleState& particles,
                        double reach,
                        const Kernels& kernels,
                        const Workers& workers) {
    if (clock_.settings().brute_force) {
        touch_.test_all(particles, objects_.list(), reach, kernels, workers);
        return true;
    }
    return touch_.test(particles, objects_.list(), reach, kernels, workers);
}

bool PairContacts::test_ahead(const ParticleState& particles,
                              double reach,
                              const Kernels& kernels,
                              const Workers& workers) {
    clock_.look_ahead(particles.smallest_radius());
    const double horizon = clock_.horizon();
    counts_are_doubtful_ = clock_.horizon_is_short() && !clock_.settings().brute_force;
    if (counts_are_doubtful_) {
        // What may touch before the next look-ahead is what touches or is in doubt until then.
        touch_.test_and_doubt(particles, objects_.list(), reach, horizon, kernels, workers);
        counts_.assign(touch_.bits().begin(), touch_.bits().end());
        for (std::size_t w = 0; w < counts_.size(); ++w) {
            counts_[w] |= touch_.doubt_bits()[w];
            counts_are_doubtful_ = counts_are_doubtful_ && counts_[w] == touch_.doubt_bits()[w];
        }
        return true;
    }
    const double soon = clock_.settings().brute_force ? everywhere : reach + 2.0 * horizon;
    test_pairs(particles, objects_.list(), soon, counts_, kernels, workers);
    return test(particles, reach, kernels, workers);
}

bool PairContacts::find_touching(const ParticleState& particles,
                                 double reach,
                                 bool looks_ahead,
                                 const Kernels& kernels,
                                 const Workers& workers) {
    if (just_renewed_ && reach > 0.0) {
        test(particles, 0.0, kernels, workers);
        adopt_late_contacts(particles);
    }
    const bool may_have_changed = looks_ahead ? test_ahead(particles, reach, kernels, workers)
                                              : test(particles, reach, kernels, workers);
    if (just_renewed_) {
        adopt_late_contacts(particles);
    }
    return objects_.set_touching(touch_.bits(), may_have_changed, kernels, workers);
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

void PairContacts::add_forces(ParticleState& particles,
                              const ContactTable& table,
                              double timestep,
                              Records records,
                              const Kernels& kernels,
                              const Workers& workers) {
    records_.prepare(records, touching().size());
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
                       .records = nullptr,
                       .stored = nullptr};
    for_each_slab(workers, [&](std::size_t slab) {
        const std::size_t first = first_touching(slab);
        PairPass pass = all;
        pass.touching += first;
        pass.touching_count = static_cast<Index>(first_touching(slab + 1) - first);
        pass.records = records_.rows_from(first);
        pass.stored = records_.stored_from(first);
        kernels.pair_pass(pass);
    });
}

void PairContacts::add_steps(ParticleState& particles,
                             const ContactTable& table,
                             bool touching_only,
                             const StepSums& sums,
                             const Kernels& kernels,
                             const Workers& workers) {
    const bool are_listed = counts_are_doubtful_ && !touching_only;
    if (!are_listed) {
        counting_.select(
            objects_.list(), touching_only ? objects_.acting() : counts_, kernels, workers);
    }
    const PairSelection& counting = are_listed ? touch_.doubtful() : counting_;
    const PairStepPass all{.particles = particles.view(),
                           .laws = table.view(0.0),
                           .i = counting.list().i.data(),
                           .j = counting.list().j.data(),
                           .count = 0,
                           .sums = sums};
    for_each_slab(workers, [&](std::size_t slab) {
        const Index first = counting.first_from(slab_start_[slab]);
        PairStepPass pass = all;
        pass.i += first;
        pass.j += first;
        pass.count = counting.first_from(slab_start_[slab + 1]) - first;
        kernels.add_pair_steps(pass);
    });
}

std::size_t PairContacts::compute_object_count(const ParticleState& particles,
                                               const Kernels& kernels) const {
    std::vector<std::uint64_t> within(objects().words());
    kernels.test_pairs(query_of(particles, objects(), 1.0 + clock_.settings().tolerance, 0.0),
                       within.data());
    return kernels.count_bits(within.data(), within.size());
}

void PairContacts::save(Archive& archive, Records records) const {
    clock_.save(archive, "pairs");
    archive.put(
        "pairs/candidate_i",
        std::vector<Index>(candidates_.i.begin(), candidates_.i.begin() + candidates_.count));
    archive.put(
        "pairs/candidate_j",
        std::vector<Index>(candidates_.j.begin(), candidates_.j.begin() + candidates_.count));
    objects_.save(archive, "pairs/objects");
    records_.save(archive, "pairs", records);
    archive.put("pairs/counters", std::vector<std::uint64_t>{late_, renewals_, builds_});
}

void PairContacts::load(const Archive& archive, const ParticleState& particles, Records records) {
    const std::size_t size = particles.size();
    clock_.load(archive, "pairs", particles);
    const std::size_t rows = particles.row_count();
    const RowOwners owner(particles);
    candidates_.load(archive, "pairs/candidate_i", "pairs/candidate_j", size, rows, owner);
    objects_.load(archive, "pairs/objects", size, rows, owner);
    touch_.forget(objects_.list());
    cut_into_slabs(particles);
    records_.load(archive, "pairs", records, touching().size());
    const auto& counters = archive.get<std::uint64_t>("pairs/counters", 3);
    late_ = counters[0];
    renewals_ = counters[1];
    builds_ = counters[2];
}

}  // namespace grainbench
