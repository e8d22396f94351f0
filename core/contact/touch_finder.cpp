#include "core/contact/touch_finder.hpp"

#include "core/contact/bits.hpp"

#include <algorithm>

namespace grainbench {

namespace {

/// Pairs that one thread tests at a time, a multiple of 64.
constexpr Index part_size = 8192;

/// Steps of the fastest particle that a list of pairs in doubt is to last: more of them where few
/// are in doubt (share/doc/performance.md).
constexpr double least_steps = 3.0;
constexpr double most_steps = 256.0;

/// Times the travel that is wanted from which on a list names too many: the bed has come to rest.
constexpr double too_wide = 8.0;

/// Least travel over the smallest radius, and the part of it that is left to rounding: positions
/// are rounded at each of the steps.
constexpr double least_margin = 1e-6;
constexpr double rounding = 0.01;

/// Tests of all pairs between two lists where the pairs in doubt were too many to pay.
constexpr int tests_without_doubt = 32;

/// Calls act(part, word) for parts of a query, with the word of the bits of their first pair.
template <class Act>
void for_each_part(const PairQuery& all, const Workers& workers, const Act& act) {
    workers.for_each((all.count + part_size - 1) / part_size, [&](std::size_t n) {
        const auto first = static_cast<Index>(n * part_size);
        PairQuery part = all;
        part.i += first;
        part.j += first;
        part.count = std::min(part_size, all.count - first);
        act(part, first / 64);
    });
}

}  // namespace

PairQuery query_of(const ParticleState& particles,
                   const PairList& list,
                   double scale,
                   double extra) {
    return {.position = particles.positions().data(),
            .i = list.i.data(),
            .j = list.j.data(),
            .count = list.count,
            .scale = scale,
            .extra = extra};
}

void test_pairs(const ParticleState& particles,
                const PairList& list,
                double reach,
                std::vector<std::uint64_t>& bits,
                const Kernels& kernels,
                const Workers& workers) {
    bits.resize(list.words());
    for_each_part(query_of(particles, list, 1.0, reach),
                  workers,
                  [&](const PairQuery& part, std::size_t word) {
                      kernels.test_pairs(part, bits.data() + word);
                  });
}

void TouchFinder::forget(const PairList& list) {
    bits_.assign(list.words(), 0);
    margin_ = 0.0;
    tests_of_all_ = 0;
}

void TouchFinder::add_travel(double bound) {
    travel_ += bound;
    last_travel_ = bound;
}

bool TouchFinder::test(const ParticleState& particles,
                       const PairList& list,
                       double reach,
                       const Kernels& kernels,
                       const Workers& workers) {
    const double wanted =
        std::max(steps_ * last_travel_, least_margin * particles.smallest_radius());
    if (doubtful_are_all(reach) && margin_ <= too_wide * wanted) {
        return test_doubtful(particles, kernels, workers);
    }
    if (tests_of_all_ > 0) {
        --tests_of_all_;
        margin_ = 0.0;  // what the list says of its pairs is old from here on
        test_all(particles, list, reach, kernels, workers);
    } else {
        test_and_doubt(particles, list, reach, wanted, kernels, workers);
        judge(list);
    }
    return true;
}

void TouchFinder::test_and_doubt(const ParticleState& particles,
                                 const PairList& list,
                                 double reach,
                                 double margin,
                                 const Kernels& kernels,
                                 const Workers& workers) {
    bits_.resize(list.words());
    doubt_bits_.resize(list.words());
    for_each_part(query_of(particles, list, 1.0, reach),
                  workers,
                  [&](const PairQuery& part, std::size_t word) {
                      kernels.test_pairs_and_doubt(
                          part, 2.0 * margin, bits_.data() + word, doubt_bits_.data() + word);
                  });
    doubtful_.select(list, doubt_bits_, kernels, workers);
    are_tested_ = false;
    margin_ = margin;
    travel_ = 0.0;
    reach_ = reach;
}

bool TouchFinder::doubtful_are_all(double reach) const {
    return reach == reach_ && travel_ < (1.0 - rounding) * margin_;
}

/// The others keep their bits.
bool TouchFinder::test_doubtful(const ParticleState& particles,
                                const Kernels& kernels,
                                const Workers& workers) {
    std::swap(touch_, touched_before_);
    test_pairs(particles, doubtful_.list(), reach_, touch_, kernels, workers);
    if (!are_tested_) {
        are_tested_ = true;
        for (std::size_t w = 0; w < bits_.size(); ++w) {
            bits_[w] &= ~doubt_bits_[w];
        }
        doubtful_.flip(touch_, bits_);
        return true;
    }
    std::vector<std::uint64_t>& changes = touched_before_;
    bool have_changed = false;
    for (std::size_t w = 0; w < changes.size(); ++w) {
        changes[w] ^= touch_[w];
        have_changed = have_changed || changes[w] != 0;
    }
    if (have_changed) {
        doubtful_.flip(changes, bits_);
    }
    return have_changed;
}

/// Chooses how long the next list of pairs in doubt is to last, and whether this one pays.
void TouchFinder::judge(const PairList& list) {
    const Index all = list.count;
    const Index count = doubtful_.list().count;
    // In tests of one pair: a test of the pairs in doubt at each step and the share in listing
    // them, against a test of all.
    const double cost = count + (1.3 * all + count) / steps_;
    if (cost > 0.9 * all) {
        margin_ = 0.0;
        tests_of_all_ = tests_without_doubt;
    }
    const double tests = count * steps_;
    const double listing = 1.3 * all;
    if (2.0 * tests < listing) {
        steps_ = std::min(2.0 * steps_, most_steps);
    } else if (tests > 2.0 * listing) {
        steps_ = std::max(0.5 * steps_, least_steps);
    }
}

}  // namespace grainbench
