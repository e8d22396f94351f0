/// Which contact laws a scene uses, with their numbers. SI units.
#pragma once

#include "core/contact/laws/constant_stiffness.hpp"
#include "core/contact/laws/coulomb_friction.hpp"
#include "core/contact/laws/deformability_stiffness.hpp"
#include "core/contact/laws/hertz_spring.hpp"
#include "core/contact/laws/hertz_stiffness.hpp"
#include "core/contact/laws/incremental_spring.hpp"
#include "core/contact/laws/jkr_adhesion.hpp"
#include "core/contact/laws/linear_cohesion.hpp"
#include "core/contact/laws/linear_spring.hpp"
#include "core/contact/laws/mindlin_friction.hpp"
#include "core/contact/laws/restitution_damping.hpp"
#include "core/contact/laws/rolling_resistance.hpp"
#include "core/contact/laws/twisting_resistance.hpp"
#include "core/contact/laws/viscous_damping.hpp"
#include "core/contact/laws/walton_braun_spring.hpp"
#include "core/describe.hpp"

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace grainbench {

using StiffnessLaw =
    std::variant<ConstantStiffness::Params, DeformabilityStiffness::Params, HertzStiffness::Params>;
using NormalLaw = std::variant<LinearSpring::Params,
                               IncrementalSpring::Params,
                               HertzSpring::Params,
                               JkrAdhesion::Params,
                               WaltonBraunSpring::Params>;
using FrictionLaw = std::variant<CoulombFriction::Params, MindlinFriction::Params>;
using DampingLaw = std::variant<ViscousDamping::Params, RestitutionDamping::Params>;
using CohesionLaw = std::variant<LinearCohesion::Params>;
using RollingLaw = std::variant<RollingResistance::Params>;
using TwistingLaw = std::variant<TwistingResistance::Params>;

/// Other numbers for one pair of materials (species or wall materials). The laws themselves are the
/// scene's: a pair can change numbers of a law that is on, not turn a law on.
struct PairContact {
    std::vector<std::string> between;
    std::optional<StiffnessLaw> stiffness;
    std::optional<NormalLaw> normal;
    std::optional<FrictionLaw> friction;
    std::optional<DampingLaw> damping;
    std::optional<CohesionLaw> cohesion;
    std::optional<RollingLaw> rolling;
    std::optional<TwistingLaw> twisting;

    static constexpr auto fields() {
        return std::tuple{
            required(&PairContact::between,
                     "between",
                     "",
                     any_number(),
                     "two names: species or wall materials"),
            field(&PairContact::stiffness, "stiffness", "", any_number(), "stiffness of this pair"),
            field(&PairContact::normal, "normal", "", any_number(), "normal spring of this pair"),
            field(&PairContact::friction, "friction", "", any_number(), "friction of this pair"),
            field(&PairContact::damping, "damping", "", any_number(), "damping of this pair"),
            field(&PairContact::cohesion, "cohesion", "", any_number(), "cohesion of this pair"),
            field(&PairContact::rolling,
                  "rolling",
                  "",
                  any_number(),
                  "rolling resistance of this pair"),
            field(&PairContact::twisting,
                  "twisting",
                  "",
                  any_number(),
                  "twisting resistance of this pair")};
    }
};

/// How far from a centre the force along the contact plane acts [m], in the moments -r n x F of
/// both bodies (F [N] on j, n [1] from i to j) and in their sliding velocity alike, so that energy
/// is kept: r = R - delta / 2, the contact point in the middle of the overlap delta (physics
/// reference 1.1; R + half the gap where only cohesion acts), or r = R, as for rigid spheres
/// (R >> delta) and in LAMMPS (pair style gran). Levers that end in one point keep the angular
/// momentum of a pair; those of length R change it by -delta n x F [N m].
enum class LeverArm { contact_point, radius };

template <>
struct EnumNames<LeverArm> {
    static constexpr std::array<std::pair<LeverArm, std::string_view>, 2> value{
        {{LeverArm::contact_point, "contact_point"}, {LeverArm::radius, "radius"}}};
};

/// Laws of all contacts. An absent optional law is off and costs nothing.
struct Contact {
    StiffnessLaw stiffness;
    NormalLaw normal;
    std::optional<FrictionLaw> friction;
    std::optional<DampingLaw> damping;
    std::optional<CohesionLaw> cohesion;
    std::optional<RollingLaw> rolling;
    std::optional<TwistingLaw> twisting;
    LeverArm lever_arm = LeverArm::contact_point;
    std::vector<PairContact> pairs;

    static constexpr auto fields() {
        return std::tuple{
            required(&Contact::stiffness, "stiffness", "", any_number(), "stiffness of contacts"),
            required(&Contact::normal, "normal", "", any_number(), "normal spring"),
            field(&Contact::friction,
                  "friction",
                  "",
                  any_number(),
                  "friction; absent = frictionless"),
            field(&Contact::damping, "damping", "", any_number(), "dashpots; absent = undamped"),
            field(&Contact::cohesion,
                  "cohesion",
                  "",
                  any_number(),
                  "attraction; absent = cohesionless"),
            field(&Contact::rolling,
                  "rolling",
                  "",
                  any_number(),
                  "moment against rolling; absent = none"),
            field(&Contact::twisting,
                  "twisting",
                  "",
                  any_number(),
                  "moment against spin about the normal; absent = none"),
            field(&Contact::lever_arm,
                  "lever_arm",
                  "",
                  any_number(),
                  "where friction and dashpots turn particles: at contact_point, in the middle of "
                  "the overlap, or at the radius, as for rigid spheres"),
            field(&Contact::pairs, "pairs", "", any_number(), "other numbers for named pairs")};
    }
};

}  // namespace grainbench
