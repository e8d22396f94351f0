/// What laws with a tangential history share: carrying a vector of the contact plane from step to
/// step, and the slider.
///
/// Model    carry: the component along the new normal is projected out, the length restored, and
///          the vector turned by the mean spin about n                                      (1)
///          slider: |F_s| <= limit, else F_s <- limit F_s / |F_s| and the contact slips      (2)
/// Source   Cundall & Strack, Geotechnique 29, 1979; PFC linear model (physics reference 1.5). (1)
///          equals the tilt by n_old x n_new to second order in the turn of one step and needs no
///          old normal in the history.
#pragma once

#include "core/contact/law.hpp"

namespace grainbench {

/// sqrt(before / after), the factor that gives a vector its length back; 0 if nothing is left
/// of it. Within a step after equals before nearly, so that a series in the difference is exact
/// to round-off, and its one division does not wait for the contact's direction.
template <class T>
T restored_length(const T& before, const T& after) {
    const T safe_before = select(T(1e-290) < before, before, T(1.0));  // 1 / before is finite
    const T loss = (before - after) * (T(1.0) / safe_before);
    const auto is_large = T(1e-4) < absolute(loss);  // the next term is 35/128 loss^4 < 3e-17
    T factor = T(1.0) + loss * (T(0.5) + loss * (T(0.375) + loss * T(0.3125)));
    if (any(is_large)) {
        const auto is_left = T{} < after;
        const T safe_after = select(is_left, after, T(1.0));
        factor = select(is_large, select(is_left, square_root(before / safe_after), T{}), factor);
    }
    return factor;
}

/// A vector of the old contact plane, in the new one (1).
template <class T>
Vec3Of<T> carry(const Geometry<T>& g, const T* history) {
    const Vec3Of<T> old{history[0], history[1], history[2]};
    Vec3Of<T> carried = old - dot(old, g.normal) * g.normal;
    carried -= (g.mean_spin * g.timestep) * cross(carried, g.normal);
    return restored_length(dot(old, old), dot(carried, carried)) * carried;
}

/// Growth of the shear force in this step, k_s alpha v_s dt.
template <class T>
Vec3Of<T> shear_increment(const Geometry<T>& g, const Load<T>& load) {
    return (load.stiffness_s * (g.entry * g.timestep)) * g.sliding_velocity;
}

/// What is left of a vector that must not be longer than `limit`, and whether it is at the limit.
/// At equality too, so that limit 0 means slipping and equals a scene without the law. The
/// factor is applied to all: a vector that only some blocks change would pass through memory.
template <class T>
struct Slider {
    typename Load<T>::Mask slipping{};
    Vec3Of<T> held{};

    Slider(const T& limit, const Vec3Of<T>& trial) {
        const T trial_square = dot(trial, trial);
        slipping = !(trial_square < limit * limit);
        T factor(1.0);
        if (any(slipping)) {
            const T trial_size = square_root(trial_square);
            const T safe_size = select(T{} < trial_size, trial_size, T(1.0));
            factor = select(slipping, limit / safe_size, factor);
        }
        held = factor * trial;  // (2)
    }
};

}  // namespace grainbench
