/// Stiffness given as a property of the contact itself.
/// Model    k_n, k_s constant                                                              (1)
/// Source   Linear contact model with properties of the contact (physics reference 1.7).
///          Departs from it in nothing.
/// Symbols  k_n, k_s normal and shear stiffness [N/m].
/// Signs    none.
/// History  none.
/// Limits   the same numbers hold for every size of particle.
#pragma once

#include "core/contact/law.hpp"
#include "core/describe.hpp"

#include <cmath>
#include <string_view>
#include <tuple>

namespace grainbench {

struct ConstantStiffness {
    struct Params {
        using Law = ConstantStiffness;
        static constexpr std::string_view key = "constant_stiffness";
        static constexpr std::string_view discriminator = "law";
        double normal = 0.0;  ///< [N/m]
        double shear = 0.0;   ///< [N/m]

        static constexpr auto fields() {
            return std::tuple{
                required(&Params::normal, "normal", "N/m", positive(), "normal stiffness k_n"),
                field(&Params::shear,
                      "shear",
                      "N/m",
                      at_least(0.0),
                      "shear stiffness k_s; needed by friction")};
        }

        friend bool operator==(const Params&, const Params&) = default;
    };

    template <class T>
    struct Values {
        T normal, shear, root_normal, root_shear;
    };

    static constexpr int value_count = 4;
    static constexpr int history_size = 0;
    static constexpr Needs needs = Needs::none;

    static void resolve(const Params& params, const MaterialPair&, double* values) {
        values[0] = params.normal;
        values[1] = params.shear;
        values[2] = std::sqrt(params.normal);
        values[3] = std::sqrt(params.shear);
    }

    template <class T>
    static void apply(const Values<T>& v, const Geometry<T>&, const T*, T*, Load<T>& load) {
        load.stiffness_n = v.normal;  // (1)
        load.stiffness_s = v.shear;
        load.root_stiffness_n = v.root_normal;
        load.root_stiffness_s = v.root_shear;
    }
};

}  // namespace grainbench
