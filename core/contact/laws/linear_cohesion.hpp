/// Linear cohesion: a constant attraction in contact that fades over a short gap.
/// Model    F_a = F_0 for gap <= 0,  F_0 (1 - gap / D) for 0 < gap < D,  0 beyond           (1)
/// Source   adhesive part of the PFC adhesive rolling resistance linear model (physics reference
///          9.6b; the linear shape is our reading). Departs from it in nothing else.
/// Symbols  F_a attraction [N]; F_0 its size in contact [N]; D reach [m]; gap between the surfaces
///          [m].
/// Signs    F_a pulls j against n, i along it.
/// History  none: making and breaking take the same path.
/// Limits   does not raise the limit of friction, which goes with the repulsion alone.
/// Conservative:
///          stores -F_0 (D/2 - gap) in contact, -F_0 (D - gap)^2 / (2 D) over the gap. D must lie
///          within the detection tolerance.
#pragma once

#include "core/contact/law.hpp"
#include "core/describe.hpp"

#include <string_view>
#include <tuple>

namespace grainbench {

struct LinearCohesion {
    struct Params {
        using Law = LinearCohesion;
        static constexpr std::string_view key = "linear_cohesion";
        static constexpr std::string_view discriminator = "law";
        double force = 0.0;  ///< [N]
        double reach = 0.0;  ///< [m]

        static constexpr auto fields() {
            return std::tuple{
                required(&Params::force, "force", "N", at_least(0.0), "attraction F_0 in contact"),
                required(&Params::reach,
                         "reach",
                         "m",
                         positive(),
                         "gap D over which the attraction fades to zero")};
        }

        friend bool operator==(const Params&, const Params&) = default;
    };

    template <class T>
    struct Values {
        T force, reach;
    };

    static constexpr int value_count = 2;
    static constexpr int history_size = 0;
    static constexpr Needs needs = Needs::gap;

    static constexpr void resolve(const Params& params, const MaterialPair&, double* values) {
        values[0] = params.force;
        values[1] = params.reach;
    }

    /// Largest gap at which it acts [m].
    static double reach(const Params& params, const MaterialPair&) { return params.reach; }

    template <class T>
    static void apply(const Values<T>& v, const Geometry<T>& g, const T*, T*, Load<T>& load) {
        const T open = larger(T{}, g.gap);
        load.attraction = larger(T{}, v.force * (T(1.0) - open / v.reach));  // (1)
        // Over the gap nothing but the attraction acts.
        const auto apart = T{} < g.gap;
        load.normal_damping = select(apart, T{}, load.normal_damping);
        load.shear_damping = select(apart, Vec3Of<T>{}, load.shear_damping);
    }

    template <class T>
    static void add_energies(const Values<T>& v, const Geometry<T>& g, const T*, Load<T>& load) {
        const T left = larger(T{}, v.reach - g.gap);
        const T over_gap = T(0.5) * left * left / v.reach;
        const T in_contact = T(0.5) * v.reach - g.gap;
        load.stored = load.stored - v.force * select(T{} < g.gap, over_gap, in_contact);
    }
};

}  // namespace grainbench
