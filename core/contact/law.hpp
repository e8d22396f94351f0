/// What a contact law is: a stateless struct with one equation, templated on the number type T
/// (double, or a vector of lanes), that declares what it reads and how much history it keeps.
///
///     struct SomeLaw {
///         struct Params { ... key, discriminator, fields() ... };   // as written in the scene
///         template <class T> struct Values { T a, b; };             // as read per contact
///         static constexpr int value_count = 2;
///         static constexpr int history_size = 0;                    // doubles per contact
///         static constexpr int turned_history = 0;                  // of them, first: components
///         of
///                                                                   // vectors on j; may be absent
///         static constexpr Needs needs = Needs::none;
///         static void resolve(const Params&, const MaterialPair&, double* values);
///         template <class T>
///         static void apply(const Values<T>&, const Geometry<T>&, const T* history_in,
///                           T* history_out, Load<T>&);
///
///         template <class T>                                        // only if it stores energy
///         static void add_energies(const Values<T>&, const Geometry<T>&, const T* history_in,
///                                  Load<T>&);                       // or dissipates by sliding
///     };
///
/// Laws are folded in the order of contact/law_table.hpp. Symbols and signs: share/doc/notation.md.
#pragma once

#include "core/types.hpp"

#include <string_view>

namespace grainbench {

/// Parts of the geometry that a law reads. The pass computes the union of what its laws need.
enum class Needs : unsigned {
    none = 0,
    velocity = 1,           ///< relative velocity of the centres, v_n
    spin = 2,               ///< spin in the relative velocity, v_s; torques result
    effective_mass = 4,     ///< m_c
    entry = 8,              ///< fraction of a first step spent in contact
    radii = 16,             ///< area radius and length of the deformability method
    effective_radius = 32,  ///< R*
    relative_spin = 64,     ///< spin of j against i; moments result
    gap = 128               ///< acts over a gap; attractions result
};

constexpr Needs operator|(Needs a, Needs b) {
    return static_cast<Needs>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}

constexpr bool contains(Needs set, Needs part) {
    return (static_cast<unsigned>(set) & static_cast<unsigned>(part)) != 0;
}

/// What a law may know of two materials when its values are resolved.
struct MaterialPair {
    std::string_view i{}, j{};     ///< names
    double density = 0.0;          ///< [kg/m^3] the larger of the species'
    double smallest_radius = 0.0;  ///< [m] of the species
    double largest_radius = 0.0;   ///< [m]
    bool hertzian = false;         ///< the stiffness is Hertz's
    double modulus = 0.0;          ///< [Pa] E*, of Hertz's stiffness
    double shear_modulus = 0.0;    ///< [Pa] G*
    double relative_depth = 0.0;   ///< [1] overlap over R* that adhesion alone makes
};

/// Kinematics of one contact per lane. Body i is a particle; j is a particle or a wall.
template <class T>
struct Geometry {
    Vec3Of<T> normal;  ///< [1] unit vector from i to j
    T overlap;         ///< [m] positive in contact
    T timestep;        ///< [s] dt of the half-step velocities
    T entry;           ///< [1] fraction of this step spent in contact, 1 unless the first
    T effective_mass;  ///< [kg] m_i m_j / (m_i + m_j); m_i against a wall
    T opening_speed;   ///< [m/s] v_n = (v_j - v_i) . n at the contact, negative on approach
    Vec3Of<T> sliding_velocity;  ///< [m/s] v_s, tangential part of the same
    T mean_spin;                 ///< [rad/s] mean of both bodies' spin about n
    T area_radius;               ///< [m] smaller radius; R_i against a wall
    T length;                    ///< [m] R_i + R_j; R_i against a wall
    T effective_radius;          ///< [m] R_i R_j / (R_i + R_j); R_i against a wall
    Vec3Of<T> relative_spin;     ///< [rad/s] of j against i
    T gap;                       ///< [m] between the surfaces, negative in contact
};

/// Forces of one contact per lane; acts on j, its opposite on i.
template <class T>
struct Load {
    using Mask = decltype(T{} < T{});

    T stiffness_n{};            ///< [N/m]
    T stiffness_s{};            ///< [N/m]
    T root_stiffness_n{};       ///< [sqrt(N/m)] for dashpots, whose constants go with the root
    T root_stiffness_s{};       ///< [sqrt(N/m)]
    T normal{};                 ///< [N] spring part, compression positive
    T limit{};                  ///< [N] what friction coefficients are multiplied with
    T attraction{};             ///< [N] of cohesion, against `normal`
    Vec3Of<T> moment{};         ///< [N m] on j, of rolling and twisting
    T kept{};                   ///< [1] part of tangential forces that a shrinking area leaves
    T normal_damping{};         ///< [N] dashpot part, same sign
    Vec3Of<T> shear{};          ///< [N] spring part
    Vec3Of<T> shear_damping{};  ///< [N] dashpot part
    Mask slipping{};  ///< shear spring is at its limit; all lanes where there is no friction law
    T slip_work{};    ///< [J] dissipated by sliding and yielding in this step
    T stored{};       ///< [J] elastic energy held by the springs; both from add_energies alone
};

/// Adds the energies of a law, if it has any, to the load that all laws have made.
template <class Law, class T>
void add_energies_of(const typename Law::template Values<T>& values,
                     const Geometry<T>& geometry,
                     const T* history_in,
                     Load<T>& load) {
    if constexpr (requires { Law::add_energies(values, geometry, history_in, load); }) {
        Law::add_energies(values, geometry, history_in, load);
    }
}

/// A stiffness law whose stiffness depends on the overlap, which the stable step must foresee.
template <class Law>
inline constexpr bool grows_with_overlap = requires(typename Law::template Values<double> values) {
    Law::expected_overlap(values, 1.0, 1.0);
};

/// Nothing: no history, no needs, no code. Fills the slot of an effect that the scene leaves out.
struct NoLaw {
    template <class T>
    struct Values {};

    static constexpr int value_count = 0;
    static constexpr int history_size = 0;
    static constexpr Needs needs = Needs::none;

    template <class T>
    static void apply(const Values<T>&, const Geometry<T>&, const T*, T*, Load<T>&) {}
};

/// The one-lane twins of the verbs that lanes offer, so that a law compiles with T = double.
constexpr double select(bool mask, double yes, double no) {
    return mask ? yes : no;
}

/// True if the mask holds for any lane: lets a block of contacts leave out what none of them needs.
constexpr bool any(bool mask) {
    return mask;
}

inline double square_root(double x) {
    return std::sqrt(x);
}

/// Smaller and larger by one comparison, so that every instruction set gives the same bits.
template <class T>
T smaller(const T& a, const T& b) {
    return select(a < b, a, b);
}

template <class T>
T larger(const T& a, const T& b) {
    return select(a < b, b, a);
}

template <class T>
T absolute(const T& a) {
    return select(a < T{}, T{} - a, a);
}

template <class M, class T>
Vec3Of<T> select(M mask, const Vec3Of<T>& yes, const Vec3Of<T>& no) {
    return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}

}  // namespace grainbench
