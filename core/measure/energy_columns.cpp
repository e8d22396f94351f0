#include "core/measure/energy_columns.hpp"

#include "core/measure/energy_ledger.hpp"

namespace grainbench {

void EnergyColumns::name_columns(std::vector<HistoryColumn>& columns) const {
    for (const auto& [name, doc] : std::initializer_list<std::pair<const char*, const char*>>{
             {"energy_kinetic_translation", "kinetic energy of translation"},
             {"energy_kinetic_rotation", "kinetic energy of rotation"},
             {"energy_potential", "in gravity, from the origin"},
             {"energy_elastic", "held by contact springs"},
             {"energy_dissipated_slip", "lost to sliding friction"},
             {"energy_dissipated_dashpot", "lost to dashpots"},
             {"energy_dissipated_local", "lost to local damping"},
             {"energy_wall_work", "work of walls and driven groups on the others"},
             {"energy_numerical", "lost by the integrator where contacts open and close"},
             {"energy_residual", "what the ledger leaves: round-off"}}) {
        columns.push_back({name, "J", doc});
    }
}

void EnergyColumns::append_row(const MeasureView& view, std::vector<double>& row) const {
    const Energies e = view.ledger->energies(
        {view.particles, view.pairs, view.walls, view.wall_contacts, view.body}, view.timestep);
    row.insert(row.end(),
               {e.kinetic_translation,
                e.kinetic_rotation,
                e.potential,
                e.elastic,
                e.dissipated_slip,
                e.dissipated_dashpot,
                e.dissipated_local,
                e.wall_work,
                e.numerical,
                e.residual});
}

}  // namespace grainbench
