/// Which of the shapes that core/describe.hpp allows a member has. Internal to io.
#pragma once

#include "core/describe.hpp"

#include <optional>
#include <string_view>
#include <variant>
#include <vector>

namespace grainbench::io {

template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;

template <class T>
inline constexpr bool is_vector = false;
template <class T>
inline constexpr bool is_vector<std::vector<T>> = true;

template <class T>
inline constexpr bool is_variant = false;
template <class... T>
inline constexpr bool is_variant<std::variant<T...>> = true;

/// Fails to compile for a member that no reader knows.
template <class T>
inline constexpr bool is_unknown = true;

template <class Variant>
constexpr std::string_view variant_discriminator() {
    return discriminator_of<std::variant_alternative_t<0, Variant>>();
}

/// Applies visit.template operator()<Alternative>() to each alternative in order.
template <class Variant, class Visit>
constexpr void for_each_alternative(Visit&& visit) {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
        (visit.template operator()<std::variant_alternative_t<I, Variant>>(), ...);
    }
    (std::make_index_sequence<std::variant_size_v<Variant>>{});
}

/// Name of a described type without its namespace: "Species"; laws lose their "::Params".
template <class T>
constexpr std::string_view type_name() {
    std::string_view text = __PRETTY_FUNCTION__;  // "... [with T = grainbench::Species; ...]"
    text.remove_prefix(text.find("T = ") + 4);
    text = text.substr(0, text.find_first_of(";]"));
    for (const std::string_view space : {"grainbench::", "render::", "cli::"}) {
        if (text.starts_with(space)) {
            text.remove_prefix(space.size());
        }
    }
    constexpr std::string_view params = "::Params";
    if (text.ends_with(params)) {
        text.remove_suffix(params.size());
    }
    return text;
}

}  // namespace grainbench::io
