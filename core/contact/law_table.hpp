/// THE table of contact laws: the slots, in order of evaluation, and the laws that may fill each.
/// The order is physics: stiffness before the springs that use it, the normal spring before
/// friction whose limit it sets, friction before the dashpots that are cut on slip. Every
/// combination becomes one instance of the contact pass (core/kernels), chosen once per stage.
#pragma once

#include "core/contact/law.hpp"
#include "core/contact/laws/constant_stiffness.hpp"
#include "core/contact/laws/coulomb_friction.hpp"
#include "core/contact/laws/deformability_stiffness.hpp"
#include "core/contact/laws/incremental_spring.hpp"
#include "core/contact/laws/linear_spring.hpp"
#include "core/contact/laws/viscous_damping.hpp"

#include <array>
#include <cstddef>
#include <tuple>
#include <utility>

namespace grainbench {

template <class... Laws>
using Slot = std::tuple<Laws...>;

using LawSlots = std::tuple<Slot<ConstantStiffness, DeformabilityStiffness>,  //
                            Slot<LinearSpring, IncrementalSpring>,            //
                            Slot<NoLaw, CoulombFriction>,                     //
                            Slot<NoLaw, ViscousDamping>>;

inline constexpr std::size_t slot_count = std::tuple_size_v<LawSlots>;

namespace detail {

template <std::size_t... S>
constexpr std::array<std::size_t, sizeof...(S)> slot_sizes(std::index_sequence<S...>) {
    return {std::tuple_size_v<std::tuple_element_t<S, LawSlots>>...};
}

}  // namespace detail

inline constexpr auto slot_sizes = detail::slot_sizes(std::make_index_sequence<slot_count>{});

/// Values before those of the laws, for the stable step: K / k normal and shear.
inline constexpr int step_factor_count = 2;

/// Which law fills each slot.
using LawChoice = std::array<std::size_t, slot_count>;

constexpr std::size_t combination_count() {
    std::size_t count = 1;
    for (const std::size_t size : slot_sizes) {
        count *= size;
    }
    return count;
}

static_assert(combination_count() <= 32, "turn a slot's choice into a per-block branch instead");

constexpr std::size_t combination_index(const LawChoice& choice) {
    std::size_t index = 0;
    for (std::size_t s = 0; s < slot_count; ++s) {
        index = index * slot_sizes[s] + choice[s];
    }
    return index;
}

constexpr LawChoice choice_of(std::size_t index) {
    LawChoice choice{};
    for (std::size_t s = slot_count; s-- > 0;) {
        choice[s] = index % slot_sizes[s];
        index /= slot_sizes[s];
    }
    return choice;
}

/// Chosen laws with the places of their values and history.
template <class... Laws>
struct LawSet {
    static constexpr Needs needs = (Laws::needs | ... | Needs::none);
    static constexpr int value_count = (Laws::value_count + ... + 0);
    static constexpr int history_size = (Laws::history_size + ... + 0);

    /// Calls visit.template operator()<Law, first value, first history>() for each law in order.
    template <class Visit>
    static constexpr void for_each(Visit&& visit) {
        constexpr auto places = first_places();
        [&]<std::size_t... L>(std::index_sequence<L...>) {
            (visit.template operator()<Laws, places[L].first, places[L].second>(), ...);
        }
        (std::index_sequence_for<Laws...>{});
    }

private:
    static constexpr auto first_places() {
        std::array<std::pair<int, int>, sizeof...(Laws)> places{};
        const std::array<std::pair<int, int>, sizeof...(Laws)> sizes{
            std::pair{Laws::value_count, Laws::history_size}...};
        for (std::size_t l = 1; l < sizeof...(Laws); ++l) {
            places[l] = {places[l - 1].first + sizes[l - 1].first,
                         places[l - 1].second + sizes[l - 1].second};
        }
        return places;
    }
};

namespace detail {

template <std::size_t Combination, std::size_t... S>
auto law_set(std::index_sequence<S...>) -> LawSet<
    std::tuple_element_t<choice_of(Combination)[S], std::tuple_element_t<S, LawSlots>>...>;

}  // namespace detail

/// The laws of one combination.
template <std::size_t Combination>
using LawSetOf = decltype(detail::law_set<Combination>(std::make_index_sequence<slot_count>{}));

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
