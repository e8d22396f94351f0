/// Whether contacts could be softer: how deep the fastest approach presses them, and what the
/// stiffness would be, and save, if that were as deep as is usually thought harmless.
///
/// Model    d / R = v sqrt(m_c / k_n) / R                                                    (1)
///          k' = k ((d / R) / bound)^2, steps grow by sqrt(k / k')                           (2)
/// Source   (1) amplitude of the undamped oscillator (physics reference 1.9); (2) from (1) and
///          dt ~ sqrt(m / k).
/// Symbols  d overlap [m]; R smaller radius [m]; v approach speed [m/s]; m_c effective mass [kg];
///          k_n, k stiffness [N/m]; bound largest harmless d / R [1]
/// Limits   weight of a deep bed presses contacts too and is not looked at; whether a flow keeps
/// its
///          result is what a study shows, not this.
#pragma once

#include "core/measure/contact_scales.hpp"

#include <optional>
#include <string>

namespace grainbench {

struct Softening {
    double speed = 0.0;          ///< [m/s] v
    double overlap_ratio = 0.0;  ///< [1] d / R of the pair that is pressed deepest, (1)
    std::string first, second;   ///< that pair
    double factor = 1.0;         ///< [1] k' / k, (2); above 1 where contacts are too soft already
    double speed_up = 1.0;       ///< [1] sqrt(k / k')
};

/// A hundredth of the radius: what the example's stiffness of 1e5 N/m gives at 1 m/s.
inline constexpr double harmless_overlap = 0.01;

/// None without contacts or speed.
std::optional<Softening> softening_of(const ContactScales& scales, double speed);

/// Of a fall through the height of all particles, along gravity [m/s]; 0 without either.
double speed_of_fall(const Scene& scene, const ParticleFrame& particles);

}  // namespace grainbench
