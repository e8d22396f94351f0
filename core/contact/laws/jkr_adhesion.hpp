/// Johnson-Kendall-Roberts: elastic spheres that adhere, and hold on until they are pulled off.
/// Model    F = 4 E* a^3 / (3 R*) - sqrt(8 pi w E* a^3)                                     (1)
///          delta = a^2 / R* - sqrt(2 pi w a / E*), on the branch 4 a^(3/2) >= R* c         (2)
///          c = sqrt(2 pi w / E*);  with a = (R* c)^(2/3) y^2, u = c (R* c)^(1/3):
///          delta = u (y^4 - y),  F = E* R* c^2 (4/3 y^6 - 2 y^3)                           (3)
///          begins at delta = 0, ends where delta falls below -0.4725 u (y^3 = 1/4)         (4)
///          for friction F_limit = F + 2 F_c,  F_c = (3/2) pi w R*                          (5)
/// Source   Johnson, Kendall & Roberts, Proc. R. Soc. A 324, 1971 (physics reference 9.5); (5)
///          Thornton, J. Phys. D 24, 1991. Departs from them in nothing.
/// Symbols  F [N] compression positive; F_c pull-off force [N]; a contact radius [m]; w work of
///          adhesion [J/m^2]; E* [Pa]; R* [m]; delta overlap, negative in a neck [m].
/// Signs    the repulsive part of (1) pushes j along n, the attractive one pulls it back.
/// History  1 double: 1 while the neck holds.
/// Limits   soft and large spheres (Tabor parameter above 5). Making a neck frees 0.3 E* c^2 v^4,
///          v^3 = R* c, breaking it 0.0315 of the same: both are dissipated. The elastic constants
///          are those of hertz_stiffness; sets the tangent stiffnesses by a.
#pragma once

#include "core/contact/law.hpp"
#include "core/describe.hpp"

#include <cmath>
#include <string_view>
#include <tuple>

namespace grainbench {

struct JkrAdhesion {
    struct Params {
        using Law = JkrAdhesion;
        static constexpr std::string_view key = "jkr_adhesion";
        static constexpr std::string_view discriminator = "law";
        double work_of_adhesion = 0.0;  ///< [J/m^2]

        static constexpr auto fields() {
            return std::tuple{required(&Params::work_of_adhesion,
                                       "work_of_adhesion",
                                       "J/m^2",
                                       positive(),
                                       "work of adhesion w, twice the surface energy")};
        }

        friend bool operator==(const Params&, const Params&) = default;
    };

    template <class T>
    struct Values {
        T modulus, eight_shear_modulus, c;
    };

    static constexpr int value_count = 3;
    static constexpr int history_size = 1;
    static constexpr Needs needs = Needs::effective_radius | Needs::gap;

    static void resolve(const Params& params, const MaterialPair& pair, double* values) {
        values[0] = pair.modulus;
        values[1] = 8.0 * pair.shear_modulus;
        values[2] = c_of(params, pair);
    }

    /// Twice the length of the longest neck, so that a neck is seen to break [m].
    static double reach(const Params& params, const MaterialPair& pair) {
        const double c = c_of(params, pair);
        return 2.0 * deepest_neck * c * std::cbrt(pair.largest_radius * c);
    }

    /// Overlap of Hertz's spheres with the contact area that adhesion alone makes, over R* [1].
    static double relative_depth(const Params& params, const MaterialPair& pair) {
        const double smallest = 0.5 * pair.smallest_radius;
        return std::pow(4.5 * pi * params.work_of_adhesion / (pair.modulus * smallest), 2.0 / 3.0);
    }

    template <class T>
    static void apply(const Values<T>& v,
                      const Geometry<T>& g,
                      const T* history_in,
                      T* history_out,
                      Load<T>& load) {
        const Neck<T> neck(v, g);
        const auto held = holds(g, neck, history_in);
        const T y3 = neck.y * neck.y * neck.y;
        const T unit = v.modulus * g.effective_radius * v.c * v.c;
        load.normal = select(held, T(4.0 / 3.0) * unit * y3 * y3, T{});  // (1) (3)
        load.attraction = select(held, T(2.0) * unit * y3, T{});
        load.limit = select(held, load.normal - load.attraction + T(1.5) * unit, T{});  // (5)
        const T a = select(held, neck.root * neck.root * neck.y * neck.y, T{});
        load.stiffness_n = T(2.0) * v.modulus * a;
        load.stiffness_s = v.eight_shear_modulus * a;
        load.root_stiffness_n = square_root(load.stiffness_n);
        load.root_stiffness_s = square_root(load.stiffness_s);
        history_out[0] = select(held, T(1.0), T{});
    }

    template <class T>
    static void add_energies(const Values<T>& v,
                             const Geometry<T>& g,
                             const T* history_in,
                             Load<T>& load) {
        const Neck<T> neck(v, g);
        const auto held = holds(g, neck, history_in);
        const auto was_held = T{} < history_in[0];
        const T root2 = neck.root * neck.root;
        const T unit = v.modulus * v.c * v.c * root2 * root2;
        const T y3 = neck.y * neck.y * neck.y;
        // The integral of F over delta, from the separated spheres.
        const T stored = neck.y * y3 * (T(0.5) + y3 * (T(8.0 / 15.0) * y3 - T(4.0 / 3.0)));
        load.stored = load.stored + select(held, unit * stored, T{});
        const T made = select(held & !was_held, T(0.3) * unit, T{});
        const T broken = select(was_held & !held, T(breaking_loss) * unit, T{});
        load.slip_work = load.slip_work + made + broken;
    }

private:
    /// -(y^4 - y) at y^3 = 1/4, and the energy left there.
    static constexpr double deepest_neck = 0.47247039371573;
    static constexpr double deepest_y = 0.62996052494744;
    static constexpr double breaking_loss = 0.031498026247372;

    static double c_of(const Params& params, const MaterialPair& pair) {
        return std::sqrt(2.0 * pi * params.work_of_adhesion / pair.modulus);
    }

    /// Newton's method from roots of roots, which start it within a tenth for x from 1e-30 up.
    template <class T>
    static T cube_root(const T& x) {
        const T fourth = square_root(square_root(x));
        const T sixteenth = square_root(square_root(fourth));
        const T sixty_fourth = square_root(square_root(sixteenth));
        T root = fourth * sixteenth * sixty_fourth * square_root(square_root(sixty_fourth));
        for (int k = 0; k < 5; ++k) {
            root = T(1.0 / 3.0) * (T(2.0) * root + x / (root * root));
        }
        return root;
    }

    /// The solution of (3) for the present overlap, at least that of the longest neck.
    template <class T>
    struct Neck {
        T root;   ///< [m^(1/3)] v = (R* c)^(1/3)
        T depth;  ///< [1] delta / u
        T y;      ///< [1]

        Neck(const Values<T>& v, const Geometry<T>& g) : root(cube_root(g.effective_radius * v.c)) {
            depth = (T{} - g.gap) / (v.c * root);
            const T above = larger(T{}, depth + T(deepest_neck));
            // Two bounds from above, from which Newton's method falls without passing the root.
            const T by_parabola = T(deepest_y) + square_root(above * T(1.0 / 2.3811016));
            const T by_quartic = T(1.0) + square_root(square_root(larger(T{}, depth)));
            y = smaller(by_parabola, by_quartic);
            const T target = above - T(deepest_neck);
            for (int k = 0; k < 7; ++k) {
                const T y3 = y * y * y;
                const T slope = T(4.0) * y3 - T(1.0);
                const T safe = select(T(1e-12) < slope, slope, T(1.0));
                const T fall = select(T(1e-12) < slope, (y * y3 - y - target) / safe, T{});
                y = y - fall;
            }
        }
    };

    template <class T>
    static auto holds(const Geometry<T>& g, const Neck<T>& neck, const T* history) {
        return ((T{} < history[0]) | !(T{} < g.gap)) & (T(-deepest_neck) < neck.depth);  // (4)
    }
};

}  // namespace grainbench
