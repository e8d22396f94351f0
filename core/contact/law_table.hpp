/// THE table of contact laws: the slots, in order of evaluation, and the laws that may fill each.
/// The order is physics: stiffness before the springs that use it, the normal spring before
/// friction whose limit it sets, friction before the dashpots that are cut on slip, cohesion after
/// the dashpots that it switches off over a gap, moments last.
///
/// The common combinations have a pass of their own, with the choice compiled in. All others share
/// one general pass, which asks once per block of contacts which laws are on
/// (share/doc/decisions/0007-laws-by-block.md): a new law adds to one pass, not to a product.
#pragma once

#include "core/contact/law.hpp"
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

#include <array>
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

namespace grainbench {

template <class... Laws>
using Slot = std::tuple<Laws...>;

using LawSlots =
    std::tuple<Slot<ConstantStiffness, DeformabilityStiffness, HertzStiffness>,
               Slot<LinearSpring, IncrementalSpring, HertzSpring, JkrAdhesion, WaltonBraunSpring>,
               Slot<NoLaw, CoulombFriction, MindlinFriction>,
               Slot<NoLaw, ViscousDamping, RestitutionDamping>,
               Slot<NoLaw, LinearCohesion>,
               Slot<NoLaw, RollingResistance>,
               Slot<NoLaw, TwistingResistance>>;

inline constexpr std::size_t slot_count = std::tuple_size_v<LawSlots>;

/// Which law fills each slot.
using LawChoice = std::array<std::size_t, slot_count>;

template <std::size_t slot, std::size_t law>
using LawAt = std::tuple_element_t<law, std::tuple_element_t<slot, LawSlots>>;

/// Place of a law in its slot.
template <class Law, std::size_t slot>
constexpr std::size_t index_of() {
    constexpr std::size_t count = std::tuple_size_v<std::tuple_element_t<slot, LawSlots>>;
    return []<std::size_t... L>(std::index_sequence<L...>) {
        std::size_t index = count;
        ((std::is_same_v<Law, LawAt<slot, L>> ? void(index = L) : void()), ...);
        return index;
    }
    (std::make_index_sequence<count>{});
}

/// Names of the slots, in order.
enum SlotName : std::size_t {
    stiffness_slot,
    normal_slot,
    friction_slot,
    damping_slot,
    cohesion_slot,
    rolling_slot,
    twisting_slot
};

/// Combinations with a pass of their own: those of the linear contact with its own damping.
constexpr bool has_own_pass(const LawChoice& c) {
    return c[stiffness_slot] <= index_of<DeformabilityStiffness, stiffness_slot>() &&
           c[normal_slot] <= index_of<IncrementalSpring, normal_slot>() &&
           c[friction_slot] <= index_of<CoulombFriction, friction_slot>() &&
           c[damping_slot] <= index_of<ViscousDamping, damping_slot>() && c[cohesion_slot] == 0 &&
           c[rolling_slot] == 0 && c[twisting_slot] == 0;
}

/// Values before those of the laws, for the stable step: K / k normal and shear.
inline constexpr int step_factor_count = 2;

namespace detail {

/// What a law takes of the columns that all laws share.
struct LawSize {
    int value_count = 0;
    int history_size = 0;
    int turned_history = 0;
    Needs needs = Needs::none;
};

/// Components of the history that change sign where i and j change places.
template <class Law>
constexpr int turned_history_of() {
    if constexpr (requires { Law::turned_history; }) {
        return Law::turned_history;
    } else {
        return 0;
    }
}

template <class... Laws>
constexpr std::array<LawSize, sizeof...(Laws)> law_sizes(Slot<Laws...>) {
    return {
        LawSize{Laws::value_count, Laws::history_size, turned_history_of<Laws>(), Laws::needs}...};
}

template <std::size_t... S>
constexpr std::array<std::size_t, sizeof...(S)> slot_sizes(std::index_sequence<S...>) {
    return {std::tuple_size_v<std::tuple_element_t<S, LawSlots>>...};
}

template <std::size_t... S>
constexpr LawSize size_of(std::size_t slot, std::size_t law, std::index_sequence<S...>) {
    LawSize size;
    ((S == slot ? void(size = law_sizes(std::tuple_element_t<S, LawSlots>{})[law]) : void()), ...);
    return size;
}

}  // namespace detail

inline constexpr auto slot_sizes = detail::slot_sizes(std::make_index_sequence<slot_count>{});

constexpr std::size_t combination_count() {
    std::size_t count = 1;
    for (const std::size_t size : slot_sizes) {
        count *= size;
    }
    return count;
}

constexpr LawChoice choice_of(std::size_t combination) {
    LawChoice choice{};
    for (std::size_t s = slot_count; s-- > 0;) {
        choice[s] = combination % slot_sizes[s];
        combination /= slot_sizes[s];
    }
    return choice;
}

/// Where the chosen laws keep their values and history.
struct LawLayout {
    std::array<int, slot_count> first_value{};
    std::array<int, slot_count> first_history{};
    std::array<int, slot_count> history_sizes{};
    std::array<int, slot_count> turned_sizes{};  ///< of the history, first: vectors on j
    int value_count = 0;
    int history_size = 0;
    Needs needs = Needs::none;
};

constexpr LawLayout layout_of(const LawChoice& choice) {
    LawLayout layout;
    for (std::size_t s = 0; s < slot_count; ++s) {
        const detail::LawSize size =
            detail::size_of(s, choice[s], std::make_index_sequence<slot_count>{});
        layout.first_value[s] = layout.value_count;
        layout.first_history[s] = layout.history_size;
        layout.history_sizes[s] = size.history_size;
        layout.turned_sizes[s] = size.turned_history;
        layout.value_count += size.value_count;
        layout.history_size += size.history_size;
        layout.needs = layout.needs | size.needs;
    }
    return layout;
}

/// Most values and history that any combination takes.
constexpr LawLayout largest_layout() {
    LawLayout largest;
    for (std::size_t s = 0; s < slot_count; ++s) {
        detail::LawSize most;
        for (std::size_t law = 0; law < slot_sizes[s]; ++law) {
            const detail::LawSize size =
                detail::size_of(s, law, std::make_index_sequence<slot_count>{});
            most.value_count =
                size.value_count > most.value_count ? size.value_count : most.value_count;
            most.history_size =
                size.history_size > most.history_size ? size.history_size : most.history_size;
        }
        largest.value_count += most.value_count;
        largest.history_size += most.history_size;
    }
    return largest;
}

namespace detail {

constexpr std::size_t own_pass_count() {
    std::size_t count = 0;
    for (std::size_t c = 0; c < combination_count(); ++c) {
        count += has_own_pass(choice_of(c)) ? 1 : 0;
    }
    return count;
}

constexpr auto own_passes() {
    std::array<LawChoice, own_pass_count()> choices{};
    std::size_t count = 0;
    for (std::size_t c = 0; c < combination_count(); ++c) {
        if (has_own_pass(choice_of(c))) {
            choices[count++] = choice_of(c);
        }
    }
    return choices;
}

}  // namespace detail

/// The combinations that have a pass of their own.
inline constexpr auto own_passes = detail::own_passes();
static_assert(own_passes.size() <= 32,
              "each costs half a second of compilation per processor kind");

/// Number of the general pass, one past those of own_passes.
inline constexpr std::size_t general_pass = own_passes.size();

/// Number of the pass for a combination.
constexpr std::size_t pass_of(const LawChoice& choice) {
    std::size_t pass = 0;
    while (pass < general_pass && own_passes[pass] != choice) {
        ++pass;
    }
    return pass;
}

/// Laws chosen when the pass is compiled. What is asked of them is constant.
template <std::size_t pass>
struct OwnLaws {
    static constexpr LawChoice choice = own_passes[pass];
    static constexpr LawLayout layout = layout_of(choice);
    static constexpr int most_values = layout.value_count;
    static constexpr int most_history = layout.history_size;

    explicit constexpr OwnLaws(const LawChoice&) {}

    static constexpr bool need(Needs part) { return contains(layout.needs, part); }

    static constexpr int value_count() { return layout.value_count; }

    static constexpr int history_size() { return layout.history_size; }

    /// Calls visit.template operator()<Law>(first value, first history) for each law in order.
    template <class Visit>
    static void for_each(Visit&& visit) {
        [&]<std::size_t... S>(std::index_sequence<S...>) {
            (visit.template operator()<LawAt<S, choice[S]>>(
                 std::integral_constant<int, layout.first_value[S]>{},
                 std::integral_constant<int, layout.first_history[S]>{}),
             ...);
        }
        (std::make_index_sequence<slot_count>{});
    }
};

/// Laws chosen when the scene is built; what is asked of them costs a branch per block of contacts,
/// always the same one.
class AnyLaws {
public:
    static constexpr int most_values = largest_layout().value_count;
    static constexpr int most_history = largest_layout().history_size;

    explicit AnyLaws(const LawChoice& choice) : choice_(choice), layout_(layout_of(choice)) {}

    bool need(Needs part) const { return contains(layout_.needs, part); }

    int value_count() const { return layout_.value_count; }

    int history_size() const { return layout_.history_size; }

    template <class Visit>
    void for_each(Visit&& visit) const {
        [&]<std::size_t... S>(std::index_sequence<S...>) {
            (visit_slot<S>(visit), ...);
        }
        (std::make_index_sequence<slot_count>{});
    }

private:
    template <std::size_t slot, class Visit>
    void visit_slot(Visit& visit) const {
        [&]<std::size_t... L>(std::index_sequence<L...>) {
            ((choice_[slot] == L ? visit.template operator()<LawAt<slot, L>>(
                                       layout_.first_value[slot], layout_.first_history[slot])
                                 : void()),
             ...);
        }
        (std::make_index_sequence<slot_sizes[slot]>{});
    }

    LawChoice choice_;
    LawLayout layout_;
};

/// Reads a law's values, in the order of its Values members, from read(k), k = 0 ... value_count
/// - 1.
template <class Law, class T, class Read>
typename Law::template Values<T> values_of(Read&& read) {
    return [&]<int... K>(std::integer_sequence<int, K...>) {
        return typename Law::template Values<T>{read(K)...};
    }
    (std::make_integer_sequence<int, Law::value_count>{});
}

}  // namespace grainbench
