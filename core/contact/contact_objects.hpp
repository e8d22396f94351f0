/// Contact objects of one kind in lexicographic order, and what lasts of them from step to step:
/// which of them act, and the history of those that do. One bit per object says whether it acts, so
/// that what opened and what closed in a step falls out of whole words.
#pragma once

#include "core/archive.hpp"
#include "core/contact/bits.hpp"
#include "core/parallel/workers.hpp"
#include "core/search/candidates.hpp"
#include "core/state/population.hpp"

#include <algorithm>
#include <span>
#include <string>

namespace grainbench {

/// Touching contacts after particles got other slots.
struct Renumbered {
    std::vector<Index> touching_before;  ///< by touching contact: its place among them before
    std::vector<bool> turned;            ///< by touching contact: i and j have changed places
};

/// Takes rows of `width` numbers into the order of `from`.
template <class Rows>
void pick_rows(Rows& rows, std::span<const Index> from, std::size_t width) {
    const Rows before = std::move(rows);
    rows = Rows(width * from.size());
    for (std::size_t k = 0; k < from.size(); ++k) {
        std::copy_n(before.begin() + static_cast<std::ptrdiff_t>(width * from[k]),
                    width,
                    rows.begin() + static_cast<std::ptrdiff_t>(width * k));
    }
}

class ContactObjects {
public:
    /// \param extra_packets kept by object behind its history
    explicit ContactObjects(int history_size = 0, Index extra_packets = 0)
        : history_size_(history_size), extra_packets_(extra_packets) {}

    /// Pairs (particle, partner), by place.
    const PairList& list() const { return list_; }

    /// Takes the pairs of a list whose bits are set as the new objects. Those that act and stay
    /// keep their history.
    /// \param owner of rows: contacts are the same if their particles are
    void renew(const PairList& from,
               std::span<const std::uint64_t> bits,
               const Kernels& kernels,
               const RowOwners& owner = {});

    /// Images are about to change: pairs name the particles themselves until the next renewal.
    void forget_images(const RowOwners& owner);

    /// Particles have other slots: objects of those that are gone go, the others keep all they
    /// have. The flag says whether the second of a pair is a slot too; the columns are those of the
    /// history that change sign where i and j change places.
    Renumbered renumber(const PopulationChange& change,
                        bool partner_is_particle,
                        std::span<const std::size_t> turned_columns = {});

    /// True if the pair of particles was in the list before the last renewal; nothing is after
    /// forget_before().
    bool was_listed(Index i, Index j) const;

    /// Gives back the room of what was before the last renewal, if it is large.
    void forget_before();

    /// Takes over which objects touch, one bit each, and forgets the history of those that opened.
    /// True if any opened or closed.
    /// \param may_have_changed false if the bits are those of the last call
    bool set_touching(std::span<const std::uint64_t> now,
                      bool may_have_changed,
                      const Kernels& kernels,
                      const Workers& workers);

    /// Objects that touch, ascending.
    std::span<const TouchingContact> touching() const {
        return {touching_.data(), touching_count_};
    }

    bool acts(Index place) const { return has_bit(acting_, place); }

    /// Makes an object act before it is found to touch: its first step counts as a whole one.
    void set_acting(Index place) { acting_[place / 64] |= std::uint64_t{1} << (place % 64); }

    /// Hands the history of an acting object on to one that does not act yet.
    void hand_over(Index from, Index to);

    std::span<const std::uint64_t> acting() const { return acting_; }

    /// Rows by place: history_packets(size) packets of history, then the extra packets.
    double* rows() { return rows_.data(); }

    double* extra(Index place) {
        return row(place) + 4 * std::size_t{history_packets(history_size_)};
    }

    const double* extra(Index place) const {
        return rows_.data() + stride() * place + 4 * std::size_t{history_packets(history_size_)};
    }

    /// Other laws from here on: column c of the history takes over sources[c]; -1 starts from zero.
    void change_history(std::span<const int> sources);

    void save(Archive& archive, const std::string& name) const;
    void load(const Archive& archive,
              const std::string& name,
              std::size_t i_end,
              std::size_t j_end,
              const RowOwners& owner = {});

private:
    /// A part of the words, and where its touching objects stand among all.
    struct Share {
        std::size_t first = 0;
        std::size_t count = 0;
        bool has_changed = false;
        bool is_listed = false;  ///< in touching_, and none of them new
    };

    template <class Owner>
    void carry_over(Index count, const Owner& owner);

    std::size_t stride() const {
        return 4 * std::size_t{history_packets(history_size_) + extra_packets_};
    }

    double* row(Index place) { return rows_.data() + stride() * place; }

    int history_size_ = 0;
    Index extra_packets_ = 0;
    PairList list_;
    std::vector<std::uint64_t> acting_;
    Column<double> rows_;  ///< by place; zero where an object does not act
    Column<TouchingContact> touching_;
    std::size_t touching_count_ = 0;
    std::vector<std::uint64_t> listed_;  ///< bit by object: stands in touching_
    std::vector<Share> shares_;          ///< empty where touching_ is yet to be listed
    bool all_are_listed_ = false;        ///< in all shares
    PairList list_before_;
    std::vector<std::uint64_t> acting_before_;
    Column<double> rows_before_;  ///< all zero, or empty: rows of the next renewal
};

}  // namespace grainbench
