/// Contacts per particle: of all particles, and of those that carry load.
///
/// Model    Z = (2 C_p + C_w) / N                                                              (1)
///          Z_m = (sum of n over particles with n >= k) / (number of particles with n >= k)    (2)
/// Source   (1) counts a contact between particles for both, one with a wall for its particle.
///          (2) with k = 2 is Thornton, Geotechnique 50 (2000) 43-53: Z_m = (2 C - N_1) / (N - N_0
///          - N_1). k = 4 leaves out what cannot be held in place without friction in space.
/// Symbols  C_p touching pairs of particles, C_w touching pairs of particle and wall (0 where walls
///          are not counted), N particles, n contacts of a particle, k `least_contacts`.
/// Limits   one pass: what is left without its rattlers may have rattlers of its own. A contact
///          that attracts over a gap (reach of a cohesion) counts. No particle: not a number.
#pragma once

#include "core/measure/measurement.hpp"
#include "core/scene.hpp"

namespace grainbench {

class Coordination : public Measurement {
public:
    explicit Coordination(const CoordinationObservable& wanted) : wanted_(wanted) {}

    void name_columns(std::vector<HistoryColumn>& columns) const override;
    void append_row(const MeasureView& view, std::vector<double>& row) const override;

private:
    CoordinationObservable wanted_;
};

/// Contacts of each particle, by slot.
std::vector<std::int32_t> contacts_by_slot(const MeasureView& view, bool with_walls);

}  // namespace grainbench
