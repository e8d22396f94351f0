/// Coulomb friction with a tangential spring whose stiffness follows the contact area.
/// Model    F_s <- min(1, k_s / k_s,old) R(F_s) - k_s alpha v_s dt                          (1)
///          |F_s| <= mu F_n, else F_s <- mu F_n F_s / |F_s| and the contact slips           (2)
///          R as in coulomb_friction                                                        (3)
/// Source   Mindlin & Deresiewicz 1953 without partial slip; the factor on unloading is that of
///          Thornton, Cummins & Cleary, Powder Technology 233, 2013 (physics reference 9.1).
///          Departs from them in nothing.
/// Symbols  F_s shear force on j [N]; k_s tangent stiffness now and in the step before [N/m]; v_s
///          sliding velocity of j past i [m/s]; mu [1]; F_n spring part of the normal force [N].
/// Signs    F_s opposes v_s; acts on j, its opposite on i.
/// History  4 doubles: F_s and k_s,old, zeroed when the contact opens.
/// Limits   no partial slip. Without the factor in (1), a contact that is sheared when deep and
///          relaxed when shallow would give energy. Stores F_s^2 / (2 k_s); sliding and the change
///          of area dissipate the rest.
#pragma once

#include "core/contact/law.hpp"
#include "core/contact/tangential.hpp"
#include "core/describe.hpp"

#include <string_view>
#include <tuple>

namespace grainbench {

struct MindlinFriction {
    struct Params {
        using Law = MindlinFriction;
        static constexpr std::string_view key = "mindlin_friction";
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
    static constexpr int history_size = 4;
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
        load.kept = kept(load, history_in);
        const Vec3Of<T> carried = load.kept * carry(g, history_in);  // (3)
        const Slider<T> slider(v.coefficient * load.limit,           // (2)
                               carried - shear_increment(g, load));  // (1)
        load.slipping = slider.slipping;
        load.shear = slider.held;
        history_out[0] = load.shear.x;
        history_out[1] = load.shear.y;
        history_out[2] = load.shear.z;
        history_out[3] = load.stiffness_s;
    }

    template <class T>
    static void add_energies(const Values<T>&,
                             const Geometry<T>& g,
                             const T* history_in,
                             Load<T>& load) {
        const Vec3Of<T> old = carry(g, history_in);
        const T safe_old = select(T{} < history_in[3], history_in[3], T(1.0));
        const T safe_now = select(T{} < load.stiffness_s, load.stiffness_s, T(1.0));
        const Vec3Of<T> carried = kept(load, history_in) * old;
        const Vec3Of<T> trial = carried - shear_increment(g, load);
        // What the change of stiffness takes, and the slide under the mean force.
        const T lost = T(0.5) * (dot(old, old) / safe_old - dot(carried, carried) / safe_now);
        const Vec3Of<T> mean_force = T(0.5) * (carried + load.shear);
        load.slip_work = load.slip_work + lost + dot(mean_force, trial - load.shear) / safe_now;
        load.stored = load.stored + T(0.5) * dot(load.shear, load.shear) / safe_now;
    }

private:
    /// Part of the tangential force that the change of the contact area leaves, (1).
    template <class T>
    static T kept(const Load<T>& load, const T* history) {
        const auto shrinks = load.stiffness_s < history[3];
        return select(shrinks, load.stiffness_s / select(shrinks, history[3], T(1.0)), T(1.0));
    }
};

}  // namespace grainbench
