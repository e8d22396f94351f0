#include "core/measure/coordination.hpp"

namespace grainbench {

std::vector<std::int32_t> contacts_by_slot(const MeasureView& view, bool with_walls) {
    std::vector<std::int32_t> contacts(view.particles.size(), 0);
    for (const TouchingContact contact : view.pairs.touching()) {
        ++contacts[view.pairs.objects().i[contact.place()]];
        ++contacts[view.particles.owner(view.pairs.objects().j[contact.place()])];
    }
    if (with_walls) {
        for (const WallContacts& wall : view.wall_contacts) {
            for (Index t = 0; t < wall.touching_count(); ++t) {
                ++contacts[wall.particle(t)];
            }
        }
    }
    return contacts;
}

void Coordination::name_columns(std::vector<HistoryColumn>& columns) const {
    const std::string walls = wanted_.walls ? ", walls counted" : ", walls not counted";
    const std::string least = std::to_string(wanted_.least_contacts);
    columns.push_back({"coordination", "1", "mean contacts of a particle" + walls});
    columns.push_back({"coordination_mechanical",
                       "1",
                       "the same of particles with at least " + least + " contacts"});
    columns.push_back({"rattler_fraction", "1", "particles with fewer than " + least});
}

void Coordination::append_row(const MeasureView& view, std::vector<double>& row) const {
    double all = 0.0;
    double held = 0.0;
    double held_count = 0.0;
    for (const std::int32_t n : contacts_by_slot(view, wanted_.walls)) {
        all += n;
        if (n >= wanted_.least_contacts) {
            held += n;
            held_count += 1.0;
        }
    }
    const auto count = static_cast<double>(view.particles.size());
    row.push_back(ratio(all, count));        // (1)
    row.push_back(ratio(held, held_count));  // (2)
    row.push_back(ratio(count - held_count, count));
}

}  // namespace grainbench
