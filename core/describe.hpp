/// Data described once: a struct lists its members in fields(), and parser, schema, reference page
/// and defaults all read that list (io/json). Knows no JSON.
///
///     struct Disc {
///         static constexpr std::string_view key = "disc";     // name in a variant
///         Vec3 centre{};
///         double radius = 1.0;
///         static constexpr auto fields() {
///             return std::tuple{
///                 field(&Disc::centre, "centre", "m", any_number(), "centre of the disc"),
///                 required(&Disc::radius, "radius", "m", positive(), "radius of the disc")};
///         }
///     };
///
/// Members may be bool, double, integers, std::string, Vec3, described enums, described structs,
/// and std::optional, std::vector or std::variant of these. The name of a field is the name of the
/// member.
#pragma once

#include <array>
#include <limits>
#include <string_view>
#include <tuple>
#include <utility>
#include <variant>

namespace grainbench {

/// Interval of allowed numbers; for a Vec3 or a vector it holds for each component.
struct Domain {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool low_open = false;
    bool high_open = false;

    constexpr bool contains(double x) const {
        return (low_open ? x > low : x >= low) && (high_open ? x < high : x <= high);
    }
};

constexpr Domain any_number() {
    return {};
}

constexpr Domain positive() {
    return {.low = 0.0, .low_open = true};
}

constexpr Domain at_least(double low) {
    return {.low = low};
}

constexpr Domain between(double low, double high) {
    return {.low = low, .high = high};
}

/// One described member. `unit` is "" where none applies, "1" for a pure number.
template <class Owner, class Member>
struct Field {
    Member Owner::*member;
    std::string_view name;
    std::string_view unit;
    Domain domain;
    bool is_required;
    std::string_view doc;
};

/// A member that keeps its default (its initialiser in the struct) when the key is absent.
template <class Owner, class Member>
constexpr Field<Owner, Member> field(Member Owner::*member,
                                     std::string_view name,
                                     std::string_view unit,
                                     Domain domain,
                                     std::string_view doc) {
    return {member, name, unit, domain, false, doc};
}

/// A member whose key must be present.
template <class Owner, class Member>
constexpr Field<Owner, Member> required(Member Owner::*member,
                                        std::string_view name,
                                        std::string_view unit,
                                        Domain domain,
                                        std::string_view doc) {
    return {member, name, unit, domain, true, doc};
}

template <class T>
concept Described = requires {
    T::fields();
};

/// An alternative of a variant: chosen by its key.
template <class T>
concept Keyed = Described<T> && requires {
    std::string_view{T::key};
};

/// Name of the JSON member that holds the key of a variant's alternative: "type", or what the first
/// alternative says (contact laws say "law").
template <class Alternative>
constexpr std::string_view discriminator_of() {
    if constexpr (requires { std::string_view{Alternative::discriminator}; }) {
        return Alternative::discriminator;
    } else {
        return "type";
    }
}

/// Described enums specialise this: static constexpr std::array<std::pair<E, std::string_view>, N>
/// value.
template <class E>
struct EnumNames;

template <class E>
concept DescribedEnum = requires {
    EnumNames<E>::value;
};

template <DescribedEnum E>
constexpr std::string_view name_of(E e) {
    for (const auto& [value, name] : EnumNames<E>::value) {
        if (value == e) {
            return name;
        }
    }
    return "";
}

/// Applies visit(field) to each described member in order.
template <Described T, class Visit>
constexpr void for_each_field(Visit&& visit) {
    std::apply([&](const auto&... each) { (visit(each), ...); }, T::fields());
}

/// Overload set for std::visit.
template <class... F>
struct Overloaded : F... {
    using F::operator()...;
};

/// For clang 14 (clang-tidy), which does not deduce the arguments of aggregates.
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

}  // namespace grainbench
