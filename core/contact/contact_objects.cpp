#include "core/contact/contact_objects.hpp"

#include <algorithm>

namespace grainbench {

namespace {

std::uint64_t key(Index i, Index j) {
    return (static_cast<std::uint64_t>(i) << 32) | j;
}

}  // namespace

void ContactObjects::renew(const PairList& from,
                           std::span<const std::uint64_t> bits,
                           const Kernels& kernels,
                           const RowOwners& owner) {
    std::swap(list_, list_before_);
    std::swap(acting_, acting_before_);
    std::swap(rows_, rows_before_);
    const auto count = static_cast<Index>(kernels.count_bits(bits.data(), bits.size()));
    list_.count = count;
    list_.pad();
    kernels.select_pairs({.bits = bits.data(),
                          .words = bits.size(),
                          .first = 0,
                          .i = from.i.data(),
                          .j = from.j.data(),
                          .place = nullptr,
                          .chosen_i = list_.i.data(),
                          .chosen_j = list_.j.data()});
    acting_.assign(list_.words(), 0);
    rows_.resize(stride() * list_.i.size());  // all zero
    touching_.resize(list_.i.size());
    touching_count_ = 0;
    shares_.clear();
    if (owner.are_trivial()) {
        carry_over(count, [](Index j) { return j; });
    } else {
        for (Index k = 0; k < list_before_.count; ++k) {
            list_before_.j[k] = owner(list_before_.j[k]);
        }
        carry_over(count, owner);
    }
}

/// Those that acted and are still listed go on. Both lists ascend by (i, owner of j).
template <class Owner>
void ContactObjects::carry_over(Index count, const Owner& owner) {
    Index k = 0;
    for_each_bit(acting_before_, [&](Index old) {
        const std::uint64_t wanted = key(list_before_.i[old], list_before_.j[old]);
        while (k < count && key(list_.i[k], owner(list_.j[k])) < wanted) {
            ++k;
        }
        if (k < count && key(list_.i[k], owner(list_.j[k])) == wanted) {
            set_acting(k);
            std::copy_n(rows_before_.data() + stride() * old, stride(), row(k));
        }
        std::fill_n(rows_before_.data() + stride() * old, stride(), 0.0);
    });
}

void ContactObjects::forget_images(const RowOwners& owner) {
    for (Index k = 0; k < list_.count; ++k) {
        list_.j[k] = owner(list_.j[k]);
    }
}

Renumbered ContactObjects::renumber(const PopulationChange& change,
                                    bool partner_is_particle,
                                    std::span<const std::size_t> turned_columns) {
    constexpr Index none = PopulationChange::gone;
    std::swap(list_, list_before_);
    std::swap(acting_, acting_before_);
    std::swap(rows_, rows_before_);

    struct Entry {
        std::uint64_t pair;
        Index before;
        bool turned;
    };

    std::vector<Entry> entries;
    for (Index k = 0; k < list_before_.count; ++k) {
        const Index i = change.slot_after[list_before_.i[k]];
        const Index j =
            partner_is_particle ? change.slot_after[list_before_.j[k]] : list_before_.j[k];
        if (i != none && (!partner_is_particle || j != none)) {
            const bool turned = partner_is_particle && j < i;
            entries.push_back({turned ? key(j, i) : key(i, j), k, turned});
        }
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
        return a.pair < b.pair;
    });
    std::vector<Index> touching_at(list_before_.count, none);
    for (Index t = 0; t < touching_count_; ++t) {
        touching_at[touching_[t].place()] = t;
    }
    const Column<TouchingContact> touching_before = touching_;
    list_.clear();
    for (const Entry& entry : entries) {
        list_.append(static_cast<Index>(entry.pair >> 32U), static_cast<Index>(entry.pair));
    }
    list_.pad();
    acting_.assign(list_.words(), 0);
    rows_.assign(stride() * list_.i.size(), 0.0);
    touching_.resize(list_.i.size());
    Renumbered result;
    for (Index k = 0; k < list_.count; ++k) {
        const Entry& entry = entries[k];
        std::copy_n(rows_before_.data() + stride() * entry.before, stride(), row(k));
        for (const std::size_t column : turned_columns) {
            row(k)[column] *= entry.turned ? -1.0 : 1.0;
        }
        if (has_bit(acting_before_, entry.before)) {
            set_acting(k);
        }
        const Index t = touching_at[entry.before];
        if (t != none) {
            touching_[result.touching_before.size()] =
                TouchingContact(k, touching_before[t].is_new());
            result.touching_before.push_back(t);
            result.turned.push_back(entry.turned);
        }
    }
    touching_count_ = result.touching_before.size();
    shares_.clear();
    rows_before_.clear();
    forget_before();
    return result;
}

bool ContactObjects::was_listed(Index i, Index j) const {
    const auto end = list_before_.i.begin() + static_cast<std::ptrdiff_t>(list_before_.count);
    const auto row = std::equal_range(list_before_.i.begin(), end, i);
    const auto first = list_before_.j.begin();
    return std::binary_search(first + (row.first - list_before_.i.begin()),
                              first + (row.second - list_before_.i.begin()),
                              j);
}

void ContactObjects::forget_before() {
    list_before_.count = 0;
    release_if_large(list_before_.i);
    release_if_large(list_before_.j);
    release_if_large(rows_before_);
}

bool ContactObjects::set_touching(std::span<const std::uint64_t> now,
                                  bool may_have_changed,
                                  const Kernels& kernels,
                                  const Workers& workers) {
    if (!may_have_changed && all_are_listed_ && !shares_.empty()) {
        return false;
    }
    constexpr std::size_t share_size = 128;  // words: enough work to be worth a thread
    shares_.resize((now.size() + share_size - 1) / share_size);
    listed_.resize(now.size());
    const auto words_of = [&](std::size_t share) {
        return std::pair{share * share_size, std::min(now.size(), (share + 1) * share_size)};
    };
    workers.for_each(shares_.size(), [&](std::size_t k) {
        Share& share = shares_[k];
        const auto [first, last] = words_of(k);
        const auto is_now = [&](const std::vector<std::uint64_t>& words) {
            return std::equal(now.data() + first, now.data() + last, words.data() + first);
        };
        share.has_changed = !is_now(acting_);
        share.is_listed = share.is_listed && !share.has_changed && is_now(listed_);
        if (!share.is_listed) {
            share.count = kernels.count_bits(now.data() + first, last - first);
        }
    });
    touching_count_ = 0;
    for (Share& share : shares_) {
        share.is_listed = share.is_listed && share.first == touching_count_;
        share.first = touching_count_;
        touching_count_ += share.count;
    }
    workers.for_each(shares_.size(), [&](std::size_t k) {
        Share& share = shares_[k];
        if (share.is_listed) {
            return;
        }
        const auto [first, last] = words_of(k);
        kernels.list_touching(now.data() + first,
                              acting_.data() + first,
                              last - first,
                              static_cast<Index>(64 * first),
                              touching_.data() + share.first);
        for (std::size_t w = first; w < last; ++w) {
            for_each_bit(acting_[w] & ~now[w], 64 * w, [&](Index place) {
                std::fill_n(row(place), stride(), 0.0);
            });
            acting_[w] = listed_[w] = now[w];
        }
        share.is_listed = !share.has_changed;
    });
    const bool any_has_changed = std::any_of(
        shares_.begin(), shares_.end(), [](const Share& share) { return share.has_changed; });
    all_are_listed_ = !any_has_changed;
    return any_has_changed;
}

void ContactObjects::hand_over(Index from, Index to) {
    std::copy_n(row(from), stride(), row(to));
    std::fill_n(row(from), stride(), 0.0);
    acting_[from / 64] &= ~(std::uint64_t{1} << (from % 64));
    set_acting(to);
}

void ContactObjects::change_history(std::span<const int> sources) {
    const ContactObjects old = *this;
    history_size_ = static_cast<int>(sources.size());
    rows_.assign(stride() * list_.i.size(), 0.0);
    for (Index k = 0; k < list_.count; ++k) {
        const double* from = old.rows_.data() + old.stride() * k;
        for (std::size_t c = 0; c < sources.size(); ++c) {
            if (sources[c] >= 0) {
                row(k)[c] = from[sources[c]];
            }
        }
        std::copy_n(old.extra(k), 4 * std::size_t{extra_packets_}, extra(k));
    }
}

void ContactObjects::save(Archive& archive, const std::string& name) const {
    archive.put(name + "/i", std::vector<Index>(list_.i.begin(), list_.i.begin() + list_.count));
    archive.put(name + "/j", std::vector<Index>(list_.j.begin(), list_.j.begin() + list_.count));
    archive.put(name + "/acting", acting_);
    archive.put(name + "/rows", std::vector<double>(rows_.begin(), rows_.end()));
}

void ContactObjects::load(const Archive& archive,
                          const std::string& name,
                          std::size_t i_end,
                          std::size_t j_end,
                          const RowOwners& owner) {
    list_.load(archive, name + "/i", name + "/j", i_end, j_end, owner);
    acting_ = archive.get<std::uint64_t>(name + "/acting", list_.words());
    const std::uint64_t beyond =
        list_.count % 64 == 0 ? 0 : ~std::uint64_t{0} << (list_.count % 64);
    Archive::require(acting_.empty() || (acting_.back() & beyond) == 0, name + "/acting");
    const auto& rows = archive.get<double>(name + "/rows", stride() * list_.i.size());
    rows_.assign(rows.begin(), rows.end());
    touching_.resize(list_.i.size());
    touching_count_ = 0;
    shares_.clear();
    for_each_bit(acting_, [&](Index place) {
        touching_[touching_count_++] = TouchingContact(place, false);
    });
}

}  // namespace grainbench
