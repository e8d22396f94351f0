/// Linear normal spring, incremental: the force is summed from the approach of each step.
/// Model    F_n <- max(0, F_n - k_n alpha v_n dt)                                           (1)
///          alpha = min(1, delta / |v_n dt|) in the first step of a contact, else 1         (2)
/// Source   PFC linear model, lin_mode 1 (physics reference 1.3, 1.4). Departs from it in the
///          clamp of alpha to [0, 1]: a contact found late, already overlapping, starts from zero
///          force and injects no energy.
/// Symbols  F_n [N] compression positive; k_n [N/m]; v_n opening speed [m/s]; delta overlap [m].
/// Signs    F_n pushes j along n, i against it.
/// History  1 double: F_n, zeroed when the contact opens.
/// Limits   equals linear_spring to round-off for contacts found in time. Stores F_n^2 / (2 k_n).
#pragma once

#include "core/contact/law.hpp"
#include "core/describe.hpp"

#include <string_view>
#include <tuple>

namespace grainbench {

struct IncrementalSpring {
    struct Params {
        using Law = IncrementalSpring;
        static constexpr std::string_view key = "incremental_spring";
        static constexpr std::string_view discriminator = "law";

        static constexpr auto fields() { return std::tuple{}; }

        friend bool operator==(const Params&, const Params&) = default;
    };

    template <class T>
    struct Values {};

    static constexpr int value_count = 0;
    static constexpr int history_size = 1;
    static constexpr Needs needs = Needs::velocity | Needs::entry;

    static constexpr void resolve(const Params&, const MaterialPair&, double*) {}

    template <class T>
    static void apply(const Values<T>&,
                      const Geometry<T>& g,
                      const T* history_in,
                      T* history_out,
                      Load<T>& load) {
        const T increment = load.stiffness_n * (g.entry * g.opening_speed * g.timestep);
        load.normal = larger(T{}, history_in[0] - increment);  // (1)
        load.limit = load.normal;
        history_out[0] = load.normal;
    }

    template <class T>
    static void add_energies(const Values<T>&, const Geometry<T>&, const T*, Load<T>& load) {
        load.stored = load.stored + T(0.5) * load.normal * load.normal / load.stiffness_n;
    }
};

}  // namespace grainbench
