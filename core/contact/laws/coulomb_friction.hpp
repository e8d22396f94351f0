/// Coulomb friction: an incremental tangential spring with a slider.
/// Model    F_s <- R(F_s) - k_s alpha v_s dt                                                (1)
///          |F_s| <= mu F_n, else F_s <- mu F_n F_s / |F_s| and the contact slips           (2)
///          R carries F_s into the new contact plane and turns it by the mean spin about n  (3)
/// Source   Cundall & Strack, Geotechnique 29, 1979; PFC linear model (physics reference 1.5).
///          Departs from it in (3): the component along the new normal is projected out and the
///          length restored, which equals the tilt by n_old x n_new to second order in the turn of
///          one step and needs no old normal in the history.
/// Symbols  F_s shear force on j [N]; k_s [N/m]; v_s sliding velocity of j past i [m/s];
///          mu [1]; F_n spring part of the normal force [N]; alpha see incremental_spring.
/// Signs    F_s opposes v_s; acts on j, its opposite on i.
/// History  3 doubles: F_s, zeroed when the contact opens.
/// Limits   mu F_n uses the spring part only, so spring plus dashpot may exceed it slightly in
///          stick. Stores F_s^2 / (2 k_s); sliding dissipates the rest.
#pragma once

#include "core/contact/law.hpp"
#include "core/describe.hpp"

#include <string_view>
#include <tuple>

namespace grainbench {

struct CoulombFriction {
    struct Params {
        using Law = CoulombFriction;
        static constexpr std::string_view key = "coulomb_friction";
        static constexpr std::string_view discriminator = "law";
        double coefficient = 0.0;  ///< [1]

        static constexpr auto fields() {
            return std::tuple{required(&Params::coefficient,
                                       "coefficient",
                                       "1",
                                       at_least(0.0),
                                       "friction coefficient mu")};
        }

        friend bool operator==(const Params&, const Params&) = default;
    };

    template <class T>
    struct Values {
        T coefficient;
    };

    static constexpr int value_count = 1;
    static constexpr int history_size = 3;
    static constexpr Needs needs = Needs::velocity | Needs::spin | Needs::entry;

    static constexpr void resolve(const Params& params, double* values) {
        values[0] = params.coefficient;
    }

    template <class T>
    static void apply(const Values<T>& v,
                      const Geometry<T>& g,
                      const T* history_in,
                      T* history_out,
                      Load<T>& load) {
        const Vec3Of<T> trial = carry(g, history_in) - increment_of(g, load);  // (1)
        const T limit = v.coefficient * load.normal;
        const T trial_square = dot(trial, trial);
        // At equality too, so that mu = 0 means slipping and equals a scene without friction.
        load.slipping = !(trial_square < limit * limit);
        load.shear = trial;
        if (any(load.slipping)) {
            const T trial_size = square_root(trial_square);
            const T safe_size = select(T{} < trial_size, trial_size, T(1.0));
            const T shrink = select(load.slipping, limit / safe_size, T(1.0));
            load.shear = shrink * trial;  // (2)
        }

        history_out[0] = load.shear.x;
        history_out[1] = load.shear.y;
        history_out[2] = load.shear.z;
    }

    template <class T>
    static void add_energies(const Values<T>&,
                             const Geometry<T>& g,
                             const T* history_in,
                             Load<T>& load) {
        const Vec3Of<T> carried = carry(g, history_in);
        const Vec3Of<T> trial = carried - increment_of(g, load);
        // Mean of the forces before and after the step, times the slide (trial - F_s) / k_s.
        const Vec3Of<T> mean_force = T(0.5) * (carried + load.shear);
        const T safe_stiffness = select(T{} < load.stiffness_s, load.stiffness_s, T(1.0));
        load.slip_work = dot(mean_force, trial - load.shear) / safe_stiffness;
        load.stored = load.stored + T(0.5) * dot(load.shear, load.shear) / safe_stiffness;
    }

private:
    /// R(F_s) of (3).
    template <class T>
    static Vec3Of<T> carry(const Geometry<T>& g, const T* history) {
        const Vec3Of<T> old{history[0], history[1], history[2]};
        Vec3Of<T> carried = old - dot(old, g.normal) * g.normal;
        carried -= (g.mean_spin * g.timestep) * cross(carried, g.normal);
        return restored_length(dot(old, old), dot(carried, carried)) * carried;
    }

    /// k_s alpha v_s dt of (1).
    template <class T>
    static Vec3Of<T> increment_of(const Geometry<T>& g, const Load<T>& load) {
        return (load.stiffness_s * (g.entry * g.timestep)) * g.sliding_velocity;
    }

    /// sqrt(before / after), the factor that gives a vector its length back; 0 if nothing is left
    /// of it. Within a step after equals before nearly, so that a series in the difference is exact
    /// to round-off, and its one division does not wait for the contact's direction.
    template <class T>
    static T restored_length(const T& before, const T& after) {
        const T safe_before = select(T(1e-290) < before, before, T(1.0));  // 1 / before is finite
        const T loss = (before - after) * (T(1.0) / safe_before);
        const auto is_large = T(1e-4) < absolute(loss);  // the next term is 35/128 loss^4 < 3e-17
        T factor = T(1.0) + loss * (T(0.5) + loss * (T(0.375) + loss * T(0.3125)));
        if (any(is_large)) {
            const auto is_left = T{} < after;
            const T safe_after = select(is_left, after, T(1.0));
            factor =
                select(is_large, select(is_left, square_root(before / safe_after), T{}), factor);
        }
        return factor;
    }
};

}  // namespace grainbench
