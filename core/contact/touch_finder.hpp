/// Which pairs of a list touch now. From time to time all are tested, and those are listed whose
/// answer may become another before particles have travelled some way; until then these pairs in
/// doubt alone are tested. A matter of speed alone: the answers are those of testing all.
#pragma once

#include "core/contact/pair_selection.hpp"
#include "core/kernels/kernels.hpp"
#include "core/state/particle_state.hpp"

namespace grainbench {

/// A list of pairs whose distance is to be compared with scale * (R_i + R_j) + extra.
PairQuery query_of(const ParticleState& particles,
                   const PairList& list,
                   double scale,
                   double extra);

/// Sets the bits of the pairs of a list whose gap is not more than `reach` [m].
void test_pairs(const ParticleState& particles,
                const PairList& list,
                double reach,
                std::vector<std::uint64_t>& bits,
                const Kernels& kernels,
                const Workers& workers);

class TouchFinder {
public:
    /// The list is another from here on.
    void forget(const PairList& list);

    /// Adds the largest distance that any particle can have moved in a step, relative to a frame.
    void add_travel(double bound);

    /// Tests the pairs of a list. False if bits() are what they were.
    /// \param reach gap up to which pairs touch [m]
    bool test(const ParticleState& particles,
              const PairList& list,
              double reach,
              const Kernels& kernels,
              const Workers& workers);

    /// Tests all pairs, and lists those whose answer may become another before a particle has
    /// travelled `margin` [m].
    void test_and_doubt(const ParticleState& particles,
                        const PairList& list,
                        double reach,
                        double margin,
                        const Kernels& kernels,
                        const Workers& workers);

    /// Tests all pairs.
    void test_all(const ParticleState& particles,
                  const PairList& list,
                  double reach,
                  const Kernels& kernels,
                  const Workers& workers) {
        test_pairs(particles, list, reach, bits_, kernels, workers);
    }

    /// By pair: whether it touches.
    std::span<const std::uint64_t> bits() const { return bits_; }

    /// By pair, after test_and_doubt: whether it is in doubt.
    std::span<const std::uint64_t> doubt_bits() const { return doubt_bits_; }

    const PairSelection& doubtful() const { return doubtful_; }

private:
    bool doubtful_are_all(double reach) const;
    bool test_doubtful(const ParticleState& particles,
                       const Kernels& kernels,
                       const Workers& workers);
    void judge(const PairList& list);

    std::vector<std::uint64_t> bits_, doubt_bits_;  ///< by pair of the list
    PairSelection doubtful_;
    std::vector<std::uint64_t> touch_, touched_before_;  ///< by pair in doubt, last and before
    bool are_tested_ = false;   ///< the pairs in doubt, since they were listed
    double margin_ = 0.0;       ///< [m] travel from when they were listed; 0 = they do not pay
    double travel_ = 0.0;       ///< [m] since then
    double reach_ = 0.0;        ///< [m] asked for then
    double last_travel_ = 0.0;  ///< [m] bound of the last step
    double steps_ = 6.0;        ///< [1] of the fastest particle: what the next list is to last
    int tests_of_all_ = 0;      ///< to come before the next list
};

}  // namespace grainbench
