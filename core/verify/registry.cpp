#include "core/verify/registry.hpp"

namespace grainbench::verify {

const std::vector<Case>& all_cases() {
    static const std::vector<Case> cases = [] {
        std::vector<Case> all;
        for (const auto topic :
             {impact_cases,       oblique_cases,        flight_cases,        rolling_cases,
              cradle_cases,       column_cases,         critical_step_cases, timestep_cases,
              detection_cases,    surface_cases,        motion_cases,        energy_cases,
              stable_step_cases,  stable_contact_cases, stable_wall_cases,   stable_rest_cases,
              stable_frame_cases, body_cases,           chung_ooi_cases,     effect_cases}) {
            for (Case& one : topic()) {
                all.push_back(std::move(one));
            }
        }
        return all;
    }();
    return cases;
}

}  // namespace grainbench::verify
