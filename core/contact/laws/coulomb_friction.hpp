/// Coulomb friction: an incremental tangential spring with a slider.
/// Model    F_s <- R(F_s) - k_s alpha v_s dt                                                (1)
///          |F_s| <= mu F_n, else F_s <- mu F_n F_s / |F_s| and the contact slips           (2)
///          R carries F_s into the new contact plane and turns it by the mean spin about n  (3)
/// Source   Cundall & Strack, Geotechnique 29, 1979; PFC linear model (physics reference 1.5).
///          Departs from it in (3), see core/contact/tangential.hpp.
/// Symbols  F_s shear force on j [N]; k_s [N/m]; v_s sliding velocity of j past i [m/s];
///          mu [1]; F_n spring part of the normal force [N]; alpha see incremental_spring.
/// Signs    F_s opposes v_s; acts on j, its opposite on i.
/// History  3 doubles: F_s, zeroed when the contact opens.
/// Limits   mu F_n uses the spring part only, so spring plus dashpot may exceed it slightly in
///          stick. Stores F_s^2 / (2 k_s); sliding dissipates the rest.
#pragma once

#include "core/contact/law.hpp"
#include "core/contact/tangential.hpp"
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
    static constexpr int turned_history = 3;
    static constexpr Needs needs = Needs::velocity | Needs::spin | Needs::entry;

    static constexpr void resolve(const Params& params, const MaterialPair&, double* values) {
        values[0] = params.coefficient;
    }

    template <class T>
    static void apply(const Values<T>& v,
                      const Geometry<T>& g,
                      const T* history_in,
                      T* history_out,
                      Load<T>& load) {
        const Vec3Of<T> trial = carry(g, history_in) - shear_increment(g, load);  // (1) (3)
        const Slider<T> slider(v.coefficient * load.limit, trial);                // (2)
        load.slipping = slider.slipping;
        load.shear = slider.held;
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
        const Vec3Of<T> trial = carried - shear_increment(g, load);
        // Mean of the forces before and after the step, times the slide (trial - F_s) / k_s.
        const Vec3Of<T> mean_force = T(0.5) * (carried + load.shear);
        const T safe_stiffness = select(T{} < load.stiffness_s, load.stiffness_s, T(1.0));
        load.slip_work = load.slip_work + dot(mean_force, trial - load.shear) / safe_stiffness;
        load.stored = load.stored + T(0.5) * dot(load.shear, load.shear) / safe_stiffness;
    }
};

}  // namespace grainbench
