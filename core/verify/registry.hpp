/// All verification cases, topic by topic.
#pragma once

#include "core/verify/case.hpp"

#include <vector>

namespace grainbench::verify {

/// In the order of the table.
const std::vector<Case>& all_cases();

// One function for each file of cases.
std::vector<Case> impact_cases();
std::vector<Case> oblique_cases();
std::vector<Case> flight_cases();
std::vector<Case> rolling_cases();
std::vector<Case> cradle_cases();
std::vector<Case> column_cases();
std::vector<Case> critical_step_cases();
std::vector<Case> timestep_cases();
std::vector<Case> detection_cases();
std::vector<Case> surface_cases();
std::vector<Case> motion_cases();
std::vector<Case> energy_cases();
std::vector<Case> body_cases();
std::vector<Case> chung_ooi_cases();
std::vector<Case> effect_cases();

// The stability catalogue (share/doc/reliability.md), names "stability/...".
std::vector<Case> stable_step_cases();
std::vector<Case> stable_contact_cases();
std::vector<Case> stable_wall_cases();
std::vector<Case> stable_rest_cases();
std::vector<Case> stable_frame_cases();

}  // namespace grainbench::verify
