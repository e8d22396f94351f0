#include "core/contact/contact_table.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <optional>
#include <tuple>

namespace grainbench {

namespace {

/// Values of one law, by its parameters.
template <class Variant>
std::vector<double> resolved(const Variant& law, const MaterialPair& pair) {
    return std::visit(
        [&](const auto& params) {
            using Law = typename std::decay_t<decltype(params)>::Law;
            std::vector<double> values(Law::value_count);
            Law::resolve(params, pair, values.data());
            return values;
        },
        law);
}

/// Place of an optional law in its slot, whose first place is for none.
template <class Law>
std::size_t place_of(const std::optional<Law>& law) {
    return law ? 1 + law->index() : 0;
}

/// The pair's law where it has one of its own.
template <class Law>
const Law& choose(const PairContact* changes,
                  std::optional<Law> PairContact::*own,
                  const Law& law) {
    return changes != nullptr && changes->*own ? *(changes->*own) : law;
}

/// Stiffness against rolling or twisting over K_s R^2 [1]; none where no moment is allowed.
template <class Params>
double moment_stiffness(const Params& law) {
    return law.coefficient > 0.0 ? law.stiffness_ratio : 0.0;
}

/// Damping ratios normal and shear [1], for the stable step.
std::pair<double, double> damping_ratios(const DampingLaw& law, const MaterialPair& pair) {
    return std::visit(Overloaded{[](const ViscousDamping::Params& p) {
                                     return std::pair{p.normal, p.shear};
                                 },
                                 [&](const RestitutionDamping::Params& p) {
                                     const double ratio =
                                         RestitutionDamping::ratio_for(p, pair.hertzian);
                                     return std::pair{ratio, ratio};
                                 }},
                      law);
}

}  // namespace

Materials::Materials(const Scene& scene) {
    for (const Species& species : scene.particles.species) {
        names_.push_back(species.name);
        densities_.push_back(species.density);
        largest_radius_ = std::max(largest_radius_, species.radius);
    }
    smallest_radius_ = largest_radius_;
    for (const Species& species : scene.particles.species) {
        smallest_radius_ = std::min(smallest_radius_, species.radius);
    }
    for (const Wall& wall : scene.walls) {
        if (std::find(names_.begin(), names_.end(), wall.material_name()) == names_.end()) {
            names_.push_back(wall.material_name());
            densities_.push_back(0.0);
        }
    }
}

Index Materials::index_of(const std::string& name) const {
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found == names_.end()) {
        throw_bad_input({.what = "no species or wall material is called '" + name + "'",
                         .where = "/contact/pairs",
                         .likely_cause = "a misspelt name",
                         .next_step = "use the name of a species, a wall or its material"});
    }
    return static_cast<Index>(found - names_.begin());
}

MaterialPair Materials::pair_of(Index i, Index j) const {
    return {.i = names_[i],
            .j = names_[j],
            .density = std::max(densities_[i], densities_[j]),
            .smallest_radius = smallest_radius_,
            .largest_radius = largest_radius_};
}

ContactTable::ContactTable(const Contact& contact, const Materials& materials)
    : choice_{contact.stiffness.index(),
              contact.normal.index(),
              place_of(contact.friction),
              place_of(contact.damping),
              place_of(contact.cohesion),
              place_of(contact.rolling),
              place_of(contact.twisting)},
      materials_(materials.count()),
      lever_cut_(contact.lever_arm == LeverArm::contact_point ? 0.5 : 0.0) {
    const int value_count = layout_of(choice_).value_count;
    const std::size_t pairs = static_cast<std::size_t>(materials_) * materials_;
    values_.assign(pairs * static_cast<std::size_t>(value_count + step_factor_count), 0.0);
    damping_.assign(2 * pairs, 0.0);
    growth_.assign(pairs, 1.0);
    for (Index a = 0; a < materials_; ++a) {
        for (Index b = 0; b < materials_; ++b) {
            resolve_pair(contact, nullptr, materials, a, b);
        }
    }
    for (const PairContact& pair : contact.pairs) {
        const Index a = materials.index_of(pair.between.at(0));
        const Index b = materials.index_of(pair.between.at(1));
        resolve_pair(contact, &pair, materials, a, b);
        resolve_pair(contact, &pair, materials, b, a);
    }
    for (const double beta : damping_) {
        const double root = std::sqrt(1.0 + beta * beta) - beta;
        step_factor_.push_back(1.0 / (root * root));
    }
    for (std::size_t row = 0; row < pairs; ++row) {
        step_factor_[2 * row] *= growth_[row];
        has_shear_damping_ = has_shear_damping_ || damping_[2 * row + 1] > 0.0;
    }
    for (std::size_t k = 0; k < step_factor_.size(); ++k) {
        values_[k % 2 * pairs + k / 2] = step_factor_[k];
    }
    uniform_ = true;
    for (std::size_t k = 0; k < values_.size(); ++k) {
        uniform_ = uniform_ && values_[k] == values_[k / pairs * pairs];
    }
    if (std::holds_alternative<ConstantStiffness::Params>(contact.stiffness)) {
        for (Index a = 0; a < materials_; ++a) {
            for (Index b = 0; b < materials_; ++b) {
                constant_.push_back(stiffness(a, b, 1.0, 1.0));
            }
        }
        rotation_rules_ = true;
        for (Index a = 0; a < materials_; ++a) {
            for (Index b = 0; b < materials_; ++b) {
                const StepStiffness k = step_stiffness(a, b, 1.0, 1.0);
                rotation_rules_ = rotation_rules_ && k.normal <= 5.0 / 3.0 * k.shear;
            }
        }
    }
}

void ContactTable::expect_impacts(double speed) {
    impact_ = std::pow(speed, 0.8);
    // A contact stiffens as the root of its overlap, and its step goes with the root of that.
    step_of_impact_ = stiffens() ? std::pow(speed, -0.2) : 1.0;
}

void ContactTable::put(Index a, Index b, int value, double x) {
    const std::size_t pairs = static_cast<std::size_t>(materials_) * materials_;
    values_[static_cast<std::size_t>(value) * pairs + a * materials_ + b] = x;
}

void ContactTable::resolve_pair(const Contact& contact,
                                const PairContact* changes,
                                const Materials& materials,
                                Index a,
                                Index b) {
    MaterialPair pair = materials.pair_of(a, b);
    const StiffnessLaw& stiffness = choose(changes, &PairContact::stiffness, contact.stiffness);
    const NormalLaw& normal = choose(changes, &PairContact::normal, contact.normal);
    if (const auto* hertz = std::get_if<HertzStiffness::Params>(&stiffness)) {
        pair.hertzian = true;
        pair.modulus = HertzStiffness::effective_modulus(*hertz, pair);
        pair.shear_modulus = HertzStiffness::effective_shear_modulus(*hertz, pair);
    }
    const std::size_t row = a * materials_ + b;
    if (const auto* jkr = std::get_if<JkrAdhesion::Params>(&normal)) {
        pair.relative_depth = JkrAdhesion::relative_depth(*jkr, pair);
        reach_ = std::max(reach_, JkrAdhesion::reach(*jkr, pair));
    }
    const auto* yielding = std::get_if<WaltonBraunSpring::Params>(&normal);
    growth_[row] = yielding != nullptr ? WaltonBraunSpring::stiffness_growth(*yielding) : 1.0;

    int next = step_factor_count;
    const auto append = [&](const auto& law) {
        for (const double value : resolved(law, pair)) {
            put(a, b, next++, value);
        }
    };
    append(stiffness);
    append(normal);
    if (contact.friction) {
        append(choose(changes, &PairContact::friction, *contact.friction));
    }
    if (contact.damping) {
        const DampingLaw& law = choose(changes, &PairContact::damping, *contact.damping);
        append(law);
        std::tie(damping_[2 * row], damping_[2 * row + 1]) = damping_ratios(law, pair);
    }
    if (contact.cohesion) {
        const CohesionLaw& law = choose(changes, &PairContact::cohesion, *contact.cohesion);
        append(law);
        const auto& cohesion = std::get<LinearCohesion::Params>(law);
        reach_ = std::max(reach_, cohesion.force > 0.0 ? cohesion.reach : 0.0);
    }
    if (contact.rolling) {
        const RollingLaw& law = choose(changes, &PairContact::rolling, *contact.rolling);
        append(law);
        rolling_ratio_ =
            std::max(rolling_ratio_, moment_stiffness(std::get<RollingResistance::Params>(law)));
    }
    if (contact.twisting) {
        const TwistingLaw& law = choose(changes, &PairContact::twisting, *contact.twisting);
        append(law);
        twisting_ratio_ =
            std::max(twisting_ratio_, moment_stiffness(std::get<TwistingResistance::Params>(law)));
    }
}

std::vector<int> history_sources(const ContactTable& before, const ContactTable& next) {
    const LawLayout old_layout = layout_of(before.choice_);
    const LawLayout new_layout = layout_of(next.choice_);
    std::vector<int> sources;
    for (std::size_t slot = 0; slot < slot_count; ++slot) {
        const bool same = before.choice_[slot] == next.choice_[slot];
        for (int h = 0; h < new_layout.history_sizes[slot]; ++h) {
            sources.push_back(same ? old_layout.first_history[slot] + h : -1);
        }
    }
    return sources;
}

std::vector<std::size_t> ContactTable::turned_columns() const {
    const LawLayout layout = layout_of(choice_);
    std::vector<std::size_t> columns;
    for (std::size_t slot = 0; slot < slot_count; ++slot) {
        for (int h = 0; h < layout.turned_sizes[slot]; ++h) {
            columns.push_back(static_cast<std::size_t>(layout.first_history[slot] + h));
        }
    }
    return columns;
}

LawView ContactTable::view(double timestep) const {
    return {values_.data(),
            static_cast<Index>(materials_ * materials_),
            materials_,
            uniform_,
            timestep,
            choice_,
            pass_of(choice_),
            impact_,
            lever_cut_};
}

ContactStiffness ContactTable::stiffness(Index material_i,
                                         Index material_j,
                                         double radius_i,
                                         double radius_j,
                                         std::optional<double> overlap) const {
    const std::size_t pair = material_i * materials_ + material_j;
    const std::size_t pairs = static_cast<std::size_t>(materials_) * materials_;
    Geometry<double> g{};
    g.area_radius = radius_j > 0.0 ? std::min(radius_i, radius_j) : radius_i;
    g.length = radius_i + radius_j;
    g.effective_radius = radius_j > 0.0 ? radius_i * radius_j / (radius_i + radius_j) : radius_i;
    Load<double> load{};
    const auto evaluate = [&]<class Law>() {
        const auto values = values_of<Law, double>([&](int k) {
            return values_[static_cast<std::size_t>(step_factor_count + k) * pairs + pair];
        });
        if constexpr (grows_with_overlap<Law>) {
            g.overlap =
                overlap ? *overlap : Law::expected_overlap(values, impact_, g.effective_radius);
        }
        const double* no_history = nullptr;
        Law::apply(values, g, no_history, static_cast<double*>(nullptr), load);
    };
    [&]<std::size_t... L>(std::index_sequence<L...>) {
        ((choice_[stiffness_slot] == L ? evaluate.template operator()<LawAt<stiffness_slot, L>>()
                                       : void()),
         ...);
    }
    (std::make_index_sequence<slot_sizes[stiffness_slot]>{});
    return {load.stiffness_n, load.stiffness_s};
}

}  // namespace grainbench
