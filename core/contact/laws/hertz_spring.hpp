/// Hertz's normal spring: the force of two elastic spheres.
/// Model    F_n = (2/3) k_n delta = (4/3) E* sqrt(R*) delta^(3/2)                           (1)
/// Source   Hertz 1881 (physics reference 9.1). Departs from it in nothing.
/// Symbols  F_n [N] compression positive; k_n tangent stiffness [N/m] of hertz_stiffness; delta
///          overlap [m]; E* [Pa]; R* [m].
/// Signs    F_n pushes j along n, i against it.
/// History  none.
/// Limits   as hertz_stiffness. Stores (2/5) F_n delta.
#pragma once

#include "core/contact/law.hpp"
#include "core/describe.hpp"

#include <string_view>
#include <tuple>

namespace grainbench {

struct HertzSpring {
    struct Params {
        using Law = HertzSpring;
        static constexpr std::string_view key = "hertz_spring";
        static constexpr std::string_view discriminator = "law";

        static constexpr auto fields() { return std::tuple{}; }

        friend bool operator==(const Params&, const Params&) = default;
    };

    template <class T>
    struct Values {};

    static constexpr int value_count = 0;
    static constexpr int history_size = 0;
    static constexpr Needs needs = Needs::none;

    static constexpr void resolve(const Params&, const MaterialPair&, double*) {}

    template <class T>
    static void apply(const Values<T>&, const Geometry<T>& g, const T*, T*, Load<T>& load) {
        load.normal = T(2.0 / 3.0) * load.stiffness_n * g.overlap;  // (1)
        load.limit = load.normal;
    }

    template <class T>
    static void add_energies(const Values<T>&, const Geometry<T>& g, const T*, Load<T>& load) {
        load.stored = load.stored + T(0.4) * load.normal * g.overlap;
    }
};

}  // namespace grainbench
