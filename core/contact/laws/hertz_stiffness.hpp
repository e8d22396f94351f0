/// Tangent stiffness of two elastic spheres in smooth contact, which grows with the overlap.
/// Model    k_n = 2 E* sqrt(R* delta),  k_s = 8 G* sqrt(R* delta)                           (1)
///          1/E* = (1 - nu_i^2)/E_i + (1 - nu_j^2)/E_j,  G = E / (2 (1 + nu)),
///          1/G* = (2 - nu_i)/G_i + (2 - nu_j)/G_j                                          (2)
///          for the stable step delta is at least (5 pi rho v^2 / E*)^(2/5) R*, and what adhesion
///          alone makes on top                                                              (3)
/// Source   Hertz 1881 for k_n, Mindlin & Deresiewicz 1953 for k_s without slip (physics reference
///          9.1). (3) is Hertz's depth of an impact at speed v between equal spheres, the deepest
///          relative to R* of all size ratios; it looks ahead to contacts that are yet to deepen.
/// Symbols  E Young's modulus [Pa]; nu Poisson's ratio [1]; G shear modulus [Pa]; R* = R_i R_j /
///          (R_i + R_j), R_i against a wall [m]; delta overlap [m]; rho larger density [kg/m^3].
/// Signs    none.
/// History  none.
/// Limits   small strains: contact radius well below R*; no adhesion, no plasticity.
#pragma once

#include "core/contact/law.hpp"
#include "core/describe.hpp"

#include <cmath>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace grainbench {

/// Elastic constants of one material.
struct ElasticMaterial {
    std::string name;
    double young_modulus = 0.0;  ///< [Pa]
    double poisson_ratio = 0.0;  ///< [1]

    static constexpr auto fields() {
        return std::tuple{
            required(&ElasticMaterial::name, "name", "", any_number(), "species or wall material"),
            required(&ElasticMaterial::young_modulus,
                     "young_modulus",
                     "Pa",
                     positive(),
                     "Young's modulus E of this material"),
            required(&ElasticMaterial::poisson_ratio,
                     "poisson_ratio",
                     "1",
                     Domain{.low = -1.0, .high = 0.5, .low_open = true},
                     "Poisson's ratio nu of this material")};
    }

    friend bool operator==(const ElasticMaterial&, const ElasticMaterial&) = default;
};

struct HertzStiffness {
    struct Params {
        using Law = HertzStiffness;
        static constexpr std::string_view key = "hertz_stiffness";
        static constexpr std::string_view discriminator = "law";
        double young_modulus = 0.0;  ///< [Pa]
        double poisson_ratio = 0.0;  ///< [1]
        std::vector<ElasticMaterial> materials{};

        static constexpr auto fields() {
            return std::tuple{required(&Params::young_modulus,
                                       "young_modulus",
                                       "Pa",
                                       positive(),
                                       "Young's modulus E of all materials not listed"),
                              required(&Params::poisson_ratio,
                                       "poisson_ratio",
                                       "1",
                                       Domain{.low = -1.0, .high = 0.5, .low_open = true},
                                       "Poisson's ratio nu of all materials not listed"),
                              field(&Params::materials,
                                    "materials",
                                    "",
                                    any_number(),
                                    "species and wall materials with constants of their own")};
        }

        friend bool operator==(const Params&, const Params&) = default;
    };

    template <class T>
    struct Values {
        T twice_modulus, eight_shear_modulus, depth, depth_at_rest;
    };

    static constexpr int value_count = 4;
    static constexpr int history_size = 0;
    static constexpr Needs needs = Needs::effective_radius;

    static void resolve(const Params& params, const MaterialPair& pair, double* values) {
        const double modulus = effective_modulus(params, pair);
        values[0] = 2.0 * modulus;
        values[1] = 8.0 * effective_shear_modulus(params, pair);
        values[2] = std::pow(5.0 * pi * pair.density / modulus, 0.4);  // (3) at 1 m/s
        values[3] = pair.relative_depth;
    }

    /// E* of (2) [Pa].
    static double effective_modulus(const Params& params, const MaterialPair& pair) {
        const auto compliance = [&](std::string_view name) {
            const auto [young, poisson] = constants(params, name);
            return (1.0 - poisson * poisson) / young;
        };
        return 1.0 / (compliance(pair.i) + compliance(pair.j));
    }

    /// G* of (2) [Pa].
    static double effective_shear_modulus(const Params& params, const MaterialPair& pair) {
        const auto compliance = [&](std::string_view name) {
            const auto [young, poisson] = constants(params, name);
            return (2.0 - poisson) * 2.0 * (1.0 + poisson) / young;
        };
        return 1.0 / (compliance(pair.i) + compliance(pair.j));
    }

    /// Overlap to expect for the stable step, (3) [m].
    /// \param impact impact speed to the power 4/5 [(m/s)^(4/5)]
    template <class T>
    static T expected_overlap(const Values<T>& v, const T& impact, const T& effective_radius) {
        return (v.depth * impact + v.depth_at_rest) * effective_radius;
    }

    template <class T>
    static void apply(const Values<T>& v, const Geometry<T>& g, const T*, T*, Load<T>& load) {
        const T contact_radius = square_root(g.effective_radius * g.overlap);
        load.stiffness_n = v.twice_modulus * contact_radius;  // (1)
        load.stiffness_s = v.eight_shear_modulus * contact_radius;
        load.root_stiffness_n = square_root(load.stiffness_n);
        load.root_stiffness_s = square_root(load.stiffness_s);
    }

private:
    static std::pair<double, double> constants(const Params& params, std::string_view name) {
        for (const ElasticMaterial& material : params.materials) {
            if (material.name == name) {
                return {material.young_modulus, material.poisson_ratio};
            }
        }
        return {params.young_modulus, params.poisson_ratio};
    }
};

}  // namespace grainbench
