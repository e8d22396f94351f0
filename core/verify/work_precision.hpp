/// What the number of steps in a contact buys: one sphere hits a plane or another sphere, and what
/// comes out is compared with the limit of small steps. Everything is measured through the engine.
///
/// Model    t_c = pi sqrt(m_c / k_n), steps = t_c / dt                                       (1)
///          error ~ steps^-p, p the slope between the two logarithms                         (2)
/// Source   (1) physics reference 1.9; (2) definition of the order of convergence.
/// Symbols  t_c duration of the undamped contact [s]; m_c effective mass [kg]; p order [1]
/// Limits   where in a step the spheres first touch is up to chance in a bed: errors are root mean
///          squares over `phases` equally likely moments. The limit is the outcome at
///          `finest_steps`.
#pragma once

#include "core/scene.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace grainbench::verify {

/// What an impact gives; pure numbers.
enum class Outcome { restitution, duration, overlap, sliding, turning, energy };

inline constexpr std::array<std::string_view, 6> outcome_names{"restitution",
                                                               "duration",
                                                               "largest overlap",
                                                               "exit velocity along the plane",
                                                               "exit spin",
                                                               "energy left"};

/// In the order of Outcome: normal velocity after over before; time with a force and depth over
/// those of the undamped contact; velocity along the plane, and R times spin, over the velocity
/// along the plane before; kinetic energy over that before.
using Outcomes = std::array<double, outcome_names.size()>;

struct ImpactLaws {
    std::string name;  ///< "linear_spring, mode 3"
    bool incremental = false;
    std::optional<int> damping_mode;  ///< of a damping ratio of 0.1; none = undamped
};

/// Both springs, undamped and with the dashpot in each mode; friction 0.6 in all.
std::vector<ImpactLaws> impact_laws();

struct WorkPoint {
    double steps = 0.0;  ///< in the undamped contact
    Outcomes error{};    ///< root mean square over the phases
};

struct WorkCurve {
    ImpactLaws laws;
    Outcomes limit{};
    std::vector<WorkPoint> points;  ///< steps rising
    Outcomes order{};               ///< p from `fewest_for_order` steps on; NaN if exact there
};

inline constexpr int phases = 16;
inline constexpr double finest_steps = 12'800.0;
inline constexpr double fewest_for_order = 50.0;

/// A sphere on a plane at 45 degrees, for each of impact_laws().
std::vector<WorkCurve> work_precision();

/// The example's small spheres, one on another, undamped, at one step.
struct StepPoint {
    double timestep = 0.0;           ///< [s]
    double steps = 0.0;              ///< in the contact
    double energy_error = 0.0;       ///< root mean square, as in WorkPoint
    double largest_error = 0.0;      ///< of all phases and angles
    double restitution_error = 0.0;  ///< root mean square
};

/// Over impacts at 15, 30, 45, 60 and 75 degrees.
std::vector<StepPoint> errors_against_step(const std::vector<double>& timesteps);

/// Above this step a pair of the example's small spheres that stick to each other is unstable [s].
double sticking_pair_limit();

/// Duration of the contact of such a pair [s].
double small_pair_contact_time();

}  // namespace grainbench::verify
