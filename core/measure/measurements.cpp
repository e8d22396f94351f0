#include "core/measure/coordination.hpp"
#include "core/measure/energy_columns.hpp"
#include "core/measure/measurement.hpp"
#include "core/measure/mixing.hpp"
#include "core/measure/regions.hpp"
#include "core/measure/repose.hpp"
#include "core/measure/wall_forces.hpp"

namespace grainbench {

std::vector<std::unique_ptr<Measurement>> build_measurements(const Scene& scene, const Vec3& up) {
    const Observables& wanted = scene.observables;
    std::vector<std::unique_ptr<Measurement>> all;
    if (wanted.energy) {
        all.push_back(std::make_unique<EnergyColumns>());
    }
    if (wanted.wall_forces) {
        all.push_back(std::make_unique<WallForces>(scene));
    }
    if (wanted.coordination) {
        all.push_back(std::make_unique<Coordination>(*wanted.coordination));
    }
    if (!wanted.regions.empty()) {
        all.push_back(std::make_unique<Regions>(scene));
    }
    if (wanted.mixing) {
        all.push_back(std::make_unique<Mixing>(scene));
    }
    for (const ReposeObservable& surface : wanted.repose) {
        all.push_back(std::make_unique<Repose>(surface, up));
    }
    return all;
}

}  // namespace grainbench
