/// What touching contacts leave behind besides their forces, by touching contact.
#pragma once

#include "core/archive.hpp"
#include "core/contact/contact_objects.hpp"
#include "core/kernels/kernels.hpp"

#include <string>

namespace grainbench {

/// What is asked of contacts: nothing, all fields of their records, or the energy of their springs
/// alone, which is a seventeenth of the memory.
enum class Records : std::uint64_t { none = 0, all = 1, stored_energy = 2 };

class ContactRecords {
public:
    /// Room for the contacts of a cycle.
    void prepare(Records wanted, std::size_t count) {
        kept_ = wanted;
        if (wanted == Records::all) {
            rows_.resize(count * record_size);
        } else {
            release_if_large(rows_);
            stored_.resize(wanted == Records::stored_energy ? count : 0);
        }
    }

    /// For a pass, from the contact `first` on; null where they are not kept.
    double* rows_from(std::size_t first) {
        return kept_ == Records::all ? rows_.data() + first * record_size : nullptr;
    }

    double* stored_from(std::size_t first) {
        return kept_ == Records::stored_energy ? stored_.data() + first : nullptr;
    }

    const double* row(Index t) const { return rows_.data() + std::size_t{t} * record_size; }

    /// Elastic energy of a contact, wherever it is kept [J].
    double stored(Index t) const {
        return kept_ == Records::all ? row(t)[record_stored] : stored_[t];
    }

    /// Whether there are records of `count` contacts.
    bool has_rows(std::size_t count) const { return rows_.size() == count * record_size; }

    /// Contacts are others, of `count` before.
    /// \param turn_row what becomes of a record where i and j change places
    template <class TurnRow>
    void renumber(const Renumbered& touching, std::size_t count, const TurnRow& turn_row) {
        if (stored_.size() == count) {
            pick_rows(stored_, touching.touching_before, 1);
        }
        if (!has_rows(count)) {
            rows_.clear();
            return;
        }
        pick_rows(rows_, touching.touching_before, record_size);
        for (std::size_t t = 0; t < touching.turned.size(); ++t) {
            if (touching.turned[t]) {
                turn_row(rows_.data() + t * record_size);
            }
        }
    }

    void save(Archive& archive, const std::string& name, Records wanted) const {
        const auto copy = [&](const Column<double>& column, Records what) {
            return wanted == what ? std::vector<double>(column.begin(), column.end())
                                  : std::vector<double>();
        };
        archive.put(name + "/records", copy(rows_, Records::all));
        if (wanted == Records::stored_energy) {
            archive.put(name + "/stored", copy(stored_, Records::stored_energy));
        }
    }

    void load(const Archive& archive, const std::string& name, Records saved, std::size_t count) {
        kept_ = saved;
        const auto& rows = archive.get<double>(name + "/records");
        rows_.assign(rows.begin(), rows.end());
        stored_.clear();
        if (saved == Records::stored_energy) {
            const auto& stored = archive.get<double>(name + "/stored", count);
            stored_.assign(stored.begin(), stored.end());
        }
    }

private:
    Records kept_ = Records::none;
    Column<double> rows_;    ///< of record_size fields
    Column<double> stored_;  ///< [J]
};

}  // namespace grainbench
