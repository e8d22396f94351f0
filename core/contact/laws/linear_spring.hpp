/// Linear normal spring, absolute: the force follows from the overlap alone.
/// Model    F_n = k_n delta                                                                 (1)
/// Source   Cundall & Strack, Geotechnique 29, 1979; PFC linear model, lin_mode 0
///          (physics reference 1.4). Departs from it in nothing.
/// Symbols  F_n [N] compression positive; k_n [N/m]; delta overlap [m].
/// Signs    F_n pushes j along n, i against it.
/// History  none.
/// Limits   a contact found late, already overlapping, injects k_n delta^2 / 2: use
///          incremental_spring where detection is relaxed. Stores F_n^2 / (2 k_n).
#pragma once

#include "core/contact/law.hpp"
#include "core/describe.hpp"

#include <string_view>
#include <tuple>

namespace grainbench {

struct LinearSpring {
    struct Params {
        using Law = LinearSpring;
        static constexpr std::string_view key = "linear_spring";
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
        load.normal = load.stiffness_n * g.overlap;  // (1)
        load.limit = load.normal;
    }

    template <class T>
    static void add_energies(const Values<T>&, const Geometry<T>&, const T*, Load<T>& load) {
        load.stored = load.stored + T(0.5) * load.normal * load.normal / load.stiffness_n;
    }
};

}  // namespace grainbench
