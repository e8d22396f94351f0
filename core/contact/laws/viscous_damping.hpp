/// Viscous dashpots, normal and shear, as fractions of critical damping.
/// Model    F_dn = -c_n v_n,  F_ds = -c_s v_s,  c = 2 beta sqrt(m_c) sqrt(k)                (1)
///          no tension (modes 1, 3): F_n + F_dn >= 0, else F_dn = -F_n                      (2)
///          cut on slip (modes 2, 3): F_ds = 0 in a step in which the shear spring slips    (3)
/// Source   PFC linear model, dp_mode 0-3 (physics reference 1.6). Departs from it in nothing.
/// Symbols  beta_n, beta_s damping ratios [1]; m_c effective mass [kg]; k_n, k_s [N/m];
///          v_n opening speed, v_s sliding velocity [m/s].
/// Signs    F_dn compression positive, as F_n; F_ds acts on j.
/// History  none.
/// Limits   restitution of a normal impact, phi = beta / sqrt(1 - beta^2): exp(-pi phi) in modes
///          0 and 2; exp(-phi (pi - 2 arcsin beta)) in modes 1 and 3. The velocity lags half a
///          step, which shrinks the stable step by sqrt(1 + beta^2) - beta. Only dissipates.
#pragma once

#include "core/contact/law.hpp"
#include "core/describe.hpp"

#include <cstdint>
#include <limits>
#include <string_view>
#include <tuple>

namespace grainbench {

struct ViscousDamping {
    struct Params {
        using Law = ViscousDamping;
        static constexpr std::string_view key = "viscous_damping";
        static constexpr std::string_view discriminator = "law";
        double normal = 0.0;    ///< [1]
        double shear = 0.0;     ///< [1]
        std::int64_t mode = 0;  ///< 0 full; 1 no tension; 2 shear cut on slip; 3 both

        static constexpr auto fields() {
            return std::tuple{
                required(&Params::normal,
                         "normal",
                         "1",
                         between(0.0, 1.0),
                         "normal damping ratio beta_n"),
                field(
                    &Params::shear, "shear", "1", between(0.0, 1.0), "shear damping ratio beta_s"),
                field(&Params::mode,
                      "mode",
                      "",
                      between(0, 3),
                      "0 full; 1 no tension; 2 shear dashpot cut on slip; 3 both")};
        }

        friend bool operator==(const Params&, const Params&) = default;
    };

    template <class T>
    struct Values {
        T minus_two_beta_n;  ///< [1]
        T minus_two_beta_s;  ///< [1]
        T least_force;       ///< [N] of spring and dashpot together: 0 or minus infinity
        T cut_on_slip;       ///< [1] 0 or 1
    };

    static constexpr int value_count = 4;
    static constexpr int history_size = 0;
    static constexpr Needs needs = Needs::velocity | Needs::spin | Needs::effective_mass;

    static constexpr void resolve(const Params& params, const MaterialPair&, double* values) {
        values[0] = -2.0 * params.normal;
        values[1] = -2.0 * params.shear;
        values[2] =
            params.mode == 1 || params.mode == 3 ? 0.0 : -std::numeric_limits<double>::infinity();
        values[3] = params.mode == 2 || params.mode == 3 ? 1.0 : 0.0;
    }

    template <class T>
    static void apply(const Values<T>& v, const Geometry<T>& g, const T*, T*, Load<T>& load) {
        const T root_mass = square_root(g.effective_mass);
        const T minus_c_n = v.minus_two_beta_n * root_mass * load.root_stiffness_n;
        const T minus_c_s = v.minus_two_beta_s * root_mass * load.root_stiffness_s;
        const T full = minus_c_n * g.opening_speed;  // (1)
        const auto pulls = load.normal + full < v.least_force;
        load.normal_damping = select(pulls, T{} - load.normal, full);  // (2)
        const auto cut = load.slipping & (T{} < v.cut_on_slip);
        const Vec3Of<T> zero{};
        load.shear_damping = select(cut, zero, minus_c_s * g.sliding_velocity);  // (3)
    }
};

}  // namespace grainbench
