/// Every law of the table as a list of types, for typed tests.
#pragma once

#include "core/contact/law_table.hpp"

#include <gtest/gtest.h>

#include <tuple>
#include <type_traits>

namespace grainbench {

namespace detail {

template <class Law>
using Kept = std::conditional_t<std::is_same_v<Law, NoLaw>, std::tuple<>, std::tuple<Law>>;

template <class... Laws>
auto without_none(Slot<Laws...>) -> decltype(std::tuple_cat(Kept<Laws>{}...));

template <class... Slots>
auto all_laws(std::tuple<Slots...>) -> decltype(std::tuple_cat(without_none(Slots{})...));

template <class Tuple>
struct TypesOf;

template <class... Laws>
struct TypesOf<std::tuple<Laws...>> {
    using Type = testing::Types<Laws...>;
};

}  // namespace detail

using AllLaws = detail::TypesOf<decltype(detail::all_laws(LawSlots{}))>::Type;

}  // namespace grainbench
