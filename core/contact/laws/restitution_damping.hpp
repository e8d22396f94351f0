/// Viscous dashpots whose ratio follows from the restitution of a normal impact.
/// Model    F_dn = -2 zeta sqrt(m_c k_n) v_n,  F_ds = -2 zeta sqrt(m_c k_s) v_s             (1)
///          with k_n, k_s the tangent stiffnesses. If the dashpot may pull:
///          zeta = c L / sqrt(L^2 + pi^2), L = -ln e, c = 1 for linear springs,
///          c = sqrt(5/6) for Hertz's                                                       (2)
///          If it may not, F_dn >= -F_n, zeta is found from the equation of motion          (3)
///          F_ds = 0 in a step in which the shear spring slips                              (4)
/// Source   Tsuji, Tanaka & Ishida, Powder Technology 71, 1992 for (2) with Hertz's spring (physics
///          reference 9.1). (3) replaces the fitted polynomial of Thornton, Cummins & Cleary 2013
///          by the solution itself.
/// Symbols  e restitution of a normal impact [1]; zeta damping ratio [1]; m_c effective mass [kg];
///          k_n, k_s [N/m]; v_n opening speed, v_s sliding velocity [m/s].
/// Signs    F_dn compression positive, as F_n; F_ds acts on j.
/// History  none.
/// Limits   e is that of an impact without friction, gravity or neighbours, at a fine step; the
///          same for all speeds. Only dissipates.
#pragma once

#include "core/contact/law.hpp"
#include "core/describe.hpp"

#include <cmath>
#include <limits>
#include <string_view>
#include <tuple>

namespace grainbench {

struct RestitutionDamping {
    struct Params {
        using Law = RestitutionDamping;
        static constexpr std::string_view key = "restitution_damping";
        static constexpr std::string_view discriminator = "law";
        double restitution = 1.0;  ///< [1]
        bool tension = true;       ///< the dashpot may pull while the surfaces part

        static constexpr auto fields() {
            return std::tuple{required(&Params::restitution,
                                       "restitution",
                                       "1",
                                       between(0.05, 1.0),
                                       "restitution e of a normal impact"),
                              field(&Params::tension,
                                    "tension",
                                    "",
                                    any_number(),
                                    "whether the dashpot may pull while the surfaces part")};
        }

        friend bool operator==(const Params&, const Params&) = default;
    };

    template <class T>
    struct Values {
        T minus_two_zeta;  ///< [1]
        T least_force;     ///< [N] of spring and dashpot together: 0 or minus infinity
    };

    static constexpr int value_count = 2;
    static constexpr int history_size = 0;
    static constexpr Needs needs = Needs::velocity | Needs::spin | Needs::effective_mass;

    static void resolve(const Params& params, const MaterialPair& pair, double* values) {
        values[0] = -2.0 * ratio_for(params, pair.hertzian);
        values[1] = params.tension ? -std::numeric_limits<double>::infinity() : 0.0;
    }

    /// zeta of (2) or (3) [1].
    static double ratio_for(const Params& params, bool hertzian) {
        const double loss = -std::log(params.restitution);
        const double plain = loss / std::sqrt(loss * loss + pi * pi);
        if (params.tension || params.restitution == 1.0) {
            return hertzian ? std::sqrt(5.0 / 6.0) * plain : plain;
        }
        auto low = 0.0;
        auto high = 8.0;
        for (int k = 0; k < 40; ++k) {  // to 1e-11
            const double middle = 0.5 * (low + high);
            (restitution_of(middle, hertzian) > params.restitution ? low : high) = middle;
        }
        return 0.5 * (low + high);
    }

    template <class T>
    static void apply(const Values<T>& v, const Geometry<T>& g, const T*, T*, Load<T>& load) {
        const T minus_twice = v.minus_two_zeta * square_root(g.effective_mass);
        const T full = minus_twice * load.root_stiffness_n * g.opening_speed;  // (1)
        const auto pulls = load.normal + full < v.least_force;
        load.normal_damping = select(pulls, T{} - load.normal, full);  // (3)
        const T minus_c_s = minus_twice * load.root_stiffness_s;
        const Vec3Of<T> zero{};
        load.shear_damping = select(load.slipping, zero, minus_c_s * g.sliding_velocity);  // (4)
    }

private:
    /// Of the impact x'' = -f(x) - 2 zeta sqrt(f'(x)) x', x(0) = 0, x'(0) = 1, until nothing pushes
    /// any more; f = x, or x^1.5 for Hertz's spring. Its step of 2e-3 leaves an error of 1e-6.
    static double restitution_of(double zeta, bool hertzian) {
        constexpr double step = 2e-3;
        const auto push = [&](double x, double v) {
            const double root = std::sqrt(x > 0.0 ? x : 0.0);
            return hertzian ? x * root + 2.0 * zeta * std::sqrt(1.5 * root) * v
                            : x + 2.0 * zeta * v;
        };
        auto x = 0.0;
        auto v = 1.0;
        do {
            const double v_half = v - 0.5 * step * push(x, v);
            const double x_half = x + 0.5 * step * v;
            v -= step * push(x_half, v_half);
            x += step * v_half;
        } while (push(x, v) > 0.0);
        return -v;
    }
};

}  // namespace grainbench
