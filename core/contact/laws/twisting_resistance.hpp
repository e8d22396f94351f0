/// Twisting resistance: an elastic-plastic spring against relative spin about the normal.
/// Model    M <- f M - k_t alpha (w_j - w_i).n dt,  k_t = s k_s R*^2                        (1)
///          |M| <= mu_t R* F_limit, else M <- +-mu_t R* F_limit                              (2)
///          f is what a shrinking contact area leaves of M, 1 with constant stiffness
/// Source   the twisting counterpart of the rolling spring of Ai et al., Powder Technology 206,
///          2011; for a patch of radius a under Coulomb friction mu, mu_t R* is about (2/3) mu a.
///          Departs from nothing else.
/// Symbols  M moment on j about n [N m]; k_t twisting stiffness [N m/rad]; k_s shear stiffness
///          [N/m]; s stiffness ratio [1]; w spins [rad/s]; mu_t [1]; R* [m]; F_limit [N].
/// Signs    M n acts on j, its opposite on i; M opposes the spin of j against i.
/// History  1 double: M, zeroed when the contact opens.
/// Limits   spheres; needs friction, whose shear stiffness it shares. Stores M^2 / (2 k_t),
///          yielding dissipates the rest. Adds up to s k_s R*^2 to the rotational stiffness of the
///          stable step.
#pragma once

#include "core/contact/law.hpp"
#include "core/describe.hpp"

#include <string_view>
#include <tuple>

namespace grainbench {

struct TwistingResistance {
    struct Params {
        using Law = TwistingResistance;
        static constexpr std::string_view key = "twisting_resistance";
        static constexpr std::string_view discriminator = "law";
        double coefficient = 0.0;      ///< [1]
        double stiffness_ratio = 1.0;  ///< [1]

        static constexpr auto fields() {
            return std::tuple{
                required(&Params::coefficient,
                         "coefficient",
                         "1",
                         at_least(0.0),
                         "twisting friction coefficient mu_t: largest moment over R* F_limit"),
                field(&Params::stiffness_ratio,
                      "stiffness_ratio",
                      "1",
                      positive(),
                      "twisting stiffness over shear stiffness times R*^2")};
        }

        friend bool operator==(const Params&, const Params&) = default;
    };

    template <class T>
    struct Values {
        T coefficient, stiffness_ratio;
    };

    static constexpr int value_count = 2;
    static constexpr int history_size = 1;
    static constexpr Needs needs = Needs::velocity | Needs::spin | Needs::entry |
                                   Needs::effective_radius | Needs::relative_spin;

    static constexpr void resolve(const Params& params, const MaterialPair&, double* values) {
        values[0] = params.coefficient;
        values[1] = params.stiffness_ratio;
    }

    template <class T>
    static void apply(const Values<T>& v,
                      const Geometry<T>& g,
                      const T* history_in,
                      T* history_out,
                      Load<T>& load) {
        history_out[0] = held(v, g, load, trial(v, g, history_in, load));
        load.moment += history_out[0] * g.normal;
    }

    template <class T>
    static void add_energies(const Values<T>& v,
                             const Geometry<T>& g,
                             const T* history_in,
                             Load<T>& load) {
        const T stiffness = twisting_stiffness(v, g, load);
        const T safe = select(T{} < stiffness, stiffness, T(1.0));
        const T old = history_in[0];
        const T tried = trial(v, g, history_in, load);
        const T now = held(v, g, load, tried);
        const T lost = T(0.5) * old * old * load.kept * (T(1.0) - load.kept);
        const T mean = T(0.5) * (load.kept * old + now);
        load.slip_work = load.slip_work + (lost + mean * (tried - now)) / safe;
        load.stored = load.stored + T(0.5) * now * now / safe;
    }

private:
    template <class T>
    static T twisting_stiffness(const Values<T>& v, const Geometry<T>& g, const Load<T>& load) {
        return v.stiffness_ratio * load.stiffness_s * g.effective_radius * g.effective_radius;
    }

    template <class T>
    static T trial(const Values<T>& v,
                   const Geometry<T>& g,
                   const T* history,
                   const Load<T>& load) {
        const T growth = twisting_stiffness(v, g, load) * (g.entry * g.timestep);
        return load.kept * history[0] - growth * dot(g.relative_spin, g.normal);  // (1)
    }

    template <class T>
    static T held(const Values<T>& v, const Geometry<T>& g, const Load<T>& load, const T& tried) {
        const T limit = v.coefficient * g.effective_radius * load.limit;
        return larger(T{} - limit, smaller(limit, tried));  // (2)
    }
};

}  // namespace grainbench
