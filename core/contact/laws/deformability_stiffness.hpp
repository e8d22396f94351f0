/// Stiffness from an effective modulus: the contact as an elastic bar between the two centres.
/// Model    k_n = s A E* / L,  k_s = k_n / kappa                                            (1)
///          A = pi r^2, r = min(R_i, R_j), L = R_i + R_j;  against a wall r = L = R_i       (2)
/// Source   PFC documentation, Linear Model, deformability method (physics reference 2.1).
///          Departs from it in the factor s, which softens all contacts alike.
/// Symbols  E* effective modulus [Pa]; kappa = k_n/k_s [1], 0 means k_s = 0; s stiffness scale [1].
/// Signs    none.
/// History  none.
/// Limits   a modulus of the bulk kind, not Hertz's: the force is linear in the overlap.
#pragma once

#include "core/contact/law.hpp"
#include "core/describe.hpp"

#include <string_view>
#include <tuple>

namespace grainbench {

struct DeformabilityStiffness {
    struct Params {
        using Law = DeformabilityStiffness;
        static constexpr std::string_view key = "deformability_stiffness";
        static constexpr std::string_view discriminator = "law";
        double modulus = 0.0;  ///< [Pa]
        double ratio = 1.0;    ///< [1]
        double scale = 1.0;    ///< [1]

        static constexpr auto fields() {
            return std::tuple{
                required(&Params::modulus, "modulus", "Pa", positive(), "effective modulus E*"),
                field(&Params::ratio,
                      "ratio",
                      "1",
                      at_least(0.0),
                      "normal over shear stiffness; 0 means no shear stiffness"),
                field(&Params::scale,
                      "scale",
                      "1",
                      positive(),
                      "factor on both stiffnesses, to soften a stiff material")};
        }

        friend bool operator==(const Params&, const Params&) = default;
    };

    template <class T>
    struct Values {
        T area_modulus, inverse_ratio;
    };

    static constexpr int value_count = 2;
    static constexpr int history_size = 0;
    static constexpr Needs needs = Needs::radii;

    static constexpr void resolve(const Params& params, const MaterialPair&, double* values) {
        values[0] = pi * params.modulus * params.scale;
        values[1] = params.ratio > 0.0 ? 1.0 / params.ratio : 0.0;
    }

    template <class T>
    static void apply(const Values<T>& v, const Geometry<T>& g, const T*, T*, Load<T>& load) {
        load.stiffness_n = v.area_modulus * g.area_radius * g.area_radius / g.length;  // (1) (2)
        load.stiffness_s = load.stiffness_n * v.inverse_ratio;
        load.root_stiffness_n = square_root(load.stiffness_n);
        load.root_stiffness_s = square_root(load.stiffness_s);
    }
};

}  // namespace grainbench
