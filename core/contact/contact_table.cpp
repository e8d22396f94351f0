#include "core/contact/contact_table.hpp"

#include "core/error.hpp"

#include <algorithm>

namespace grainbench {

namespace {

/// Values of one law, by its parameters.
template <class Params>
std::array<double, 8> resolved(const Params& params) {
    static_assert(Params::Law::value_count <= 8);
    std::array<double, 8> values{};
    Params::Law::resolve(params, values.data());
    return values;
}

template <class Variant>
std::pair<std::array<double, 8>, int> resolved_choice(const Variant& law) {
    return std::visit(
        [](const auto& params) {
            using Law = typename std::decay_t<decltype(params)>::Law;
            return std::pair{resolved(params), Law::value_count};
        },
        law);
}

}  // namespace

Materials::Materials(const Scene& scene) {
    for (const Species& species : scene.particles.species) {
        names_.push_back(species.name);
    }
    for (const Wall& wall : scene.walls) {
        if (std::find(names_.begin(), names_.end(), wall.material_name()) == names_.end()) {
            names_.push_back(wall.material_name());
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

ContactTable::ContactTable(const Contact& contact, const Materials& materials)
    : choice_{contact.stiffness.index(),
              contact.normal.index(),
              contact.friction ? 1 + contact.friction->index() : 0,
              contact.damping ? 1 + contact.damping->index() : 0},
      materials_(materials.count()) {
    const int value_count = layout_of(choice_).value_count;
    const std::size_t pairs = static_cast<std::size_t>(materials_) * materials_;
    values_.assign(pairs * static_cast<std::size_t>(value_count + step_factor_count), 0.0);
    damping_.assign(2 * pairs, 0.0);
    for (Index a = 0; a < materials_; ++a) {
        for (Index b = 0; b < materials_; ++b) {
            resolve_pair(contact, nullptr, a, b);
        }
    }
    for (const PairContact& pair : contact.pairs) {
        const Index a = materials.index_of(pair.between.at(0));
        const Index b = materials.index_of(pair.between.at(1));
        resolve_pair(contact, &pair, a, b);
        resolve_pair(contact, &pair, b, a);
    }
    for (const double beta : damping_) {
        const double root = std::sqrt(1.0 + beta * beta) - beta;
        step_factor_.push_back(1.0 / (root * root));
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

void ContactTable::put(Index a, Index b, int value, double x) {
    const std::size_t pairs = static_cast<std::size_t>(materials_) * materials_;
    values_[static_cast<std::size_t>(value) * pairs + a * materials_ + b] = x;
}

void ContactTable::resolve_pair(const Contact& contact,
                                const PairContact* changes,
                                Index a,
                                Index b) {
    int next = step_factor_count;
    const auto append = [&](const auto& law) {
        const auto [values, count] = resolved_choice(law);
        for (int k = 0; k < count; ++k) {
            put(a, b, next++, values[static_cast<std::size_t>(k)]);
        }
    };
    append(changes != nullptr && changes->stiffness ? *changes->stiffness : contact.stiffness);
    append(contact.normal);
    if (contact.friction) {
        append(changes != nullptr && changes->friction ? *changes->friction : *contact.friction);
    }
    if (contact.damping) {
        const DampingLaw& law =
            changes != nullptr && changes->damping ? *changes->damping : *contact.damping;
        append(law);
        const auto& dashpots = std::get<ViscousDamping::Params>(law);
        const std::size_t pair = a * materials_ + b;
        damping_[2 * pair] = dashpots.normal;
        damping_[2 * pair + 1] = dashpots.shear;
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

LawView ContactTable::view(double timestep) const {
    return {values_.data(),
            static_cast<Index>(materials_ * materials_),
            materials_,
            uniform_,
            timestep,
            choice_,
            pass_of(choice_)};
}

ContactStiffness ContactTable::stiffness(Index material_i,
                                         Index material_j,
                                         double radius_i,
                                         double radius_j) const {
    const std::size_t pair = material_i * materials_ + material_j;
    const std::size_t pairs = static_cast<std::size_t>(materials_) * materials_;
    Geometry<double> g{};
    g.area_radius = radius_j > 0.0 ? std::min(radius_i, radius_j) : radius_i;
    g.length = radius_i + radius_j;
    Load<double> load{};
    const auto evaluate = [&]<class Law>(Law) {
        const auto values = values_of<Law, double>([&](int k) {
            return values_[static_cast<std::size_t>(step_factor_count + k) * pairs + pair];
        });
        const double* no_history = nullptr;
        Law::apply(values, g, no_history, static_cast<double*>(nullptr), load);
    };
    if (choice_[0] == 0) {
        evaluate(ConstantStiffness{});
    } else {
        evaluate(DeformabilityStiffness{});
    }
    return {load.stiffness_n, load.stiffness_s};
}

}  // namespace grainbench
