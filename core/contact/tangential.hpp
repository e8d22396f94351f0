/// What laws with a tangential history share: carrying a vector of the contact plane from step to
/// step, and the slider.
///
/// Model    carry: the component along the new normal is projected out, the length restored, and
///          the vector turned by the mean spin about n                                      (1)
///          slider: |F_s| <= limit, else F_s <- limit F_s / |F_s| and the contact slips      (2)
/// Source   Cundall & Strack, Geotechnique 29, 1979; PFC linear model (physics reference 1.5). (1)
///          equals the tilt by n_old x n_new to second order in the turn of one step and needs no
///          old normal in the history.
/// Symbols  F_s force [N] of friction or moment [N m] of a resistance, limit the same; n unit
///          normal [1].
#pragma once

#include "core/contact/law.hpp"

namespace grainbench {

/// sqrt(before / |carried|^2), the factor that gives a vector its length back; 0 if nothing is left
/// of it. Within a step it is 1 nearly, and a series exact to round-off.
/// \param loss 1 - |carried|^2 / before
template <class T>
T restored_length(const T& before, const T& loss, const Vec3Of<T>& carried) {
    const auto is_large = T(1e-4) < absolute(loss);  // the next term is 35/128 loss^4 < 3e-17
    T factor = (T(1.0) + T(0.5) * loss) + loss * loss * (T(0.375) + T(0.3125) * loss);
    if (any(is_large)) {
        const T after = dot(carried, carried);
        const auto is_left = T{} < after;
        const T safe_after = select(is_left, after, T(1.0));
        factor = select(is_large, select(is_left, square_root(before / safe_after), T{}), factor);
    }
    return factor;
}

/// A vector of the old contact plane, in the new one (1). Its length follows from what is projected
/// out and turned, |carried|^2 = (1 - tilt) (1 + turn^2) |old|^2, so that it need not wait for the
/// vector. Where particles rest both are below round-off, and the factor is 1 whatever they are.
template <class T>
Vec3Of<T> carry(const Geometry<T>& g, const T* history) {
    const Vec3Of<T> old{history[0], history[1], history[2]};
    const T along = dot(old, g.normal);
    const T turn = g.mean_spin * g.timestep;
    const Vec3Of<T> carried = old - along * g.normal - turn * cross(old, g.normal);
    const T before = dot(old, old);
    const T along_square = along * along;
    const T turn_square = turn * turn;
    const T least(1e-16);  // half of it is lost when it is added to 1
    T factor(1.0);
    if (any((least * before < along_square) | (least < turn_square))) {
        const T safe_before = select(T(1e-290) < before, before, T(1.0));  // 1 / before is finite
        const T tilt = along_square * (T(1.0) / safe_before);
        factor = restored_length(before, tilt - turn_square * (T(1.0) - tilt), carried);
    }
    return factor * carried;
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
