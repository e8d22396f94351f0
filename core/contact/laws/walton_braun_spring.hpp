/// Walton-Braun spring: a partly latching spring that yields, so that impacts lose energy.
/// Model    delta_0 <- max(delta_0, delta (1 - e^2))                                        (1)
///          F_n = max(0, k_2 (delta - delta_0)),  k_2 = k_n / e^2                           (2)
///          which is k_n delta on first loading, and k_2 (delta - delta_0) on the way back
/// Source   Walton & Braun, J. Rheology 30, 1986, with constant k_2 (physics reference 9.4).
///          Departs from it in nothing.
/// Symbols  F_n [N] compression positive; k_n, k_2 stiffness of loading and of unloading [N/m]; e
///          restitution of a normal impact [1]; delta overlap, delta_0 what is left of it where the
///          force has fallen to zero [m].
/// Signs    F_n pushes j along n, i against it.
/// History  1 double: delta_0, zeroed when the contact opens.
/// Limits   e does not depend on speed. Stores F_n^2 / (2 k_2); yielding dissipates the rest. The
///          stable step is that of k_2.
#pragma once

#include "core/contact/law.hpp"
#include "core/describe.hpp"

#include <string_view>
#include <tuple>

namespace grainbench {

struct WaltonBraunSpring {
    struct Params {
        using Law = WaltonBraunSpring;
        static constexpr std::string_view key = "walton_braun_spring";
        static constexpr std::string_view discriminator = "law";
        double restitution = 1.0;  ///< [1]

        static constexpr auto fields() {
            return std::tuple{required(&Params::restitution,
                                       "restitution",
                                       "1",
                                       between(0.05, 1.0),
                                       "restitution e of a normal impact")};
        }

        friend bool operator==(const Params&, const Params&) = default;
    };

    template <class T>
    struct Values {
        T growth, latched;
    };

    static constexpr int value_count = 2;
    static constexpr int history_size = 1;
    static constexpr Needs needs = Needs::none;

    static constexpr void resolve(const Params& params, const MaterialPair&, double* values) {
        values[0] = stiffness_growth(params);
        values[1] = 1.0 - params.restitution * params.restitution;
    }

    /// k_2 / k_n [1].
    static constexpr double stiffness_growth(const Params& params) {
        return 1.0 / (params.restitution * params.restitution);
    }

    template <class T>
    static void apply(const Values<T>& v,
                      const Geometry<T>& g,
                      const T* history_in,
                      T* history_out,
                      Load<T>& load) {
        const T rest = larger(history_in[0], g.overlap * v.latched);                  // (1)
        load.normal = larger(T{}, v.growth * load.stiffness_n * (g.overlap - rest));  // (2)
        load.limit = load.normal;
        history_out[0] = rest;
    }

    template <class T>
    static void add_energies(const Values<T>& v,
                             const Geometry<T>& g,
                             const T* history_in,
                             Load<T>& load) {
        load.stored =
            load.stored + T(0.5) * load.normal * load.normal / (v.growth * load.stiffness_n);
        // The integral of F over delta_0 along the loading line, where F = k_n delta_0 / (1 - e^2).
        const T rest = larger(history_in[0], g.overlap * v.latched);
        const auto latches = T{} < v.latched;
        const T yielded = T(0.5) * load.stiffness_n / select(latches, v.latched, T(1.0)) *
                          (rest * rest - history_in[0] * history_in[0]);
        load.slip_work = load.slip_work + select(latches, yielded, T{});
    }
};

}  // namespace grainbench
