/// Rolling resistance: an elastic-plastic spring against relative rolling.
/// Model    M <- f R(M) - k_r alpha (w_j - w_i)_t dt,  k_r = s k_s R*^2                     (1)
///          |M| <= mu_r R* F_limit, else M <- mu_r R* F_limit M / |M|                       (2)
///          R carries M into the new contact plane as a shear force, f is what a shrinking contact
///          area leaves of it, 1 with constant stiffness                                    (3)
/// Source   PFC rolling resistance linear model; model C of Ai et al., Powder Technology 206, 2011
///          (physics reference 9.3). Departs from model C in that it has no dashpot.
/// Symbols  M moment on j [N m]; k_r rolling stiffness [N m/rad]; k_s shear stiffness [N/m]; s
///          stiffness ratio [1]; w spins, t their part along the contact plane [rad/s]; mu_r [1];
///          R* effective radius [m]; F_limit [N] as for friction.
/// Signs    M opposes the rolling of j over i; acts on j, its opposite on i.
/// History  3 doubles: M, zeroed when the contact opens.
/// Limits   spheres; needs friction, whose shear stiffness it shares. Stores M^2 / (2 k_r),
///          yielding dissipates the rest. Adds up to s k_s R*^2 to the rotational stiffness of the
///          stable step.
#pragma once

#include "core/contact/law.hpp"
#include "core/contact/tangential.hpp"
#include "core/describe.hpp"

#include <string_view>
#include <tuple>

namespace grainbench {

struct RollingResistance {
    struct Params {
        using Law = RollingResistance;
        static constexpr std::string_view key = "rolling_resistance";
        static constexpr std::string_view discriminator = "law";
        double coefficient = 0.0;      ///< [1]
        double stiffness_ratio = 1.0;  ///< [1]

        static constexpr auto fields() {
            return std::tuple{
                required(&Params::coefficient,
                         "coefficient",
                         "1",
                         at_least(0.0),
                         "rolling friction coefficient mu_r: largest moment over R* F_limit"),
                field(&Params::stiffness_ratio,
                      "stiffness_ratio",
                      "1",
                      positive(),
                      "rolling stiffness over shear stiffness times R*^2")};
        }

        friend bool operator==(const Params&, const Params&) = default;
    };

    template <class T>
    struct Values {
        T coefficient, stiffness_ratio;
    };

    static constexpr int value_count = 2;
    static constexpr int history_size = 3;
    static constexpr int turned_history = 3;
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
        const Slider<T> slider(v.coefficient * g.effective_radius * load.limit,  // (2)
                               trial(v, g, history_in, load));
        load.moment += slider.held;
        history_out[0] = slider.held.x;
        history_out[1] = slider.held.y;
        history_out[2] = slider.held.z;
    }

    template <class T>
    static void add_energies(const Values<T>& v,
                             const Geometry<T>& g,
                             const T* history_in,
                             Load<T>& load) {
        const T stiffness = rolling_stiffness(v, g, load);
        const T safe = select(T{} < stiffness, stiffness, T(1.0));
        const Vec3Of<T> old = carry(g, history_in);
        const Vec3Of<T> tried = trial(v, g, history_in, load);
        const Vec3Of<T> held =
            Slider<T>(v.coefficient * g.effective_radius * load.limit, tried).held;
        // Where the area shrinks, 1 / k_old = f / k_r.
        const T lost = T(0.5) * dot(old, old) * load.kept * (T(1.0) - load.kept);
        const Vec3Of<T> mean = T(0.5) * (load.kept * old + held);
        load.slip_work = load.slip_work + (lost + dot(mean, tried - held)) / safe;
        load.stored = load.stored + T(0.5) * dot(held, held) / safe;
    }

private:
    template <class T>
    static T rolling_stiffness(const Values<T>& v, const Geometry<T>& g, const Load<T>& load) {
        return v.stiffness_ratio * load.stiffness_s * g.effective_radius * g.effective_radius;
    }

    template <class T>
    static Vec3Of<T> trial(const Values<T>& v,
                           const Geometry<T>& g,
                           const T* history,
                           const Load<T>& load) {
        const Vec3Of<T> rolling = g.relative_spin - dot(g.relative_spin, g.normal) * g.normal;
        const T growth = rolling_stiffness(v, g, load) * (g.entry * g.timestep);
        return load.kept * carry(g, history) - growth * rolling;  // (1) (3)
    }
};

}  // namespace grainbench
