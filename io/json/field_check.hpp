/// Domains of all numbers of a described struct, for scenes that were built or changed in code.
/// Internal to io.
#pragma once

#include "core/describe.hpp"
#include "core/types.hpp"

#include "io/json/problems.hpp"
#include "io/json/type_traits.hpp"

#include <cmath>
#include <concepts>
#include <variant>
#include <vector>

namespace grainbench::io {

/// Adds a problem for each number that is not finite or lies outside its domain.
template <class T>
void check_domains(const T& value,
                   const Place& place,
                   const Domain& domain,
                   std::string_view unit,
                   Problems& problems) {
    if constexpr (std::same_as<T, double> || std::same_as<T, std::int64_t>) {
        const auto number = static_cast<double>(value);
        if (!std::isfinite(number) || !domain.contains(number)) {
            problems.add(out_of_domain(place.pointer(), number, domain, unit));
        }
    } else if constexpr (std::same_as<T, Vec3>) {
        check_domains(value.x, place.child(0), domain, unit, problems);
        check_domains(value.y, place.child(1), domain, unit, problems);
        check_domains(value.z, place.child(2), domain, unit, problems);
    } else if constexpr (is_optional<T>) {
        if (value) {
            check_domains(*value, place, domain, unit, problems);
        }
    } else if constexpr (is_vector<T>) {
        for (std::size_t i = 0; i < value.size(); ++i) {
            check_domains(value[i], place.child(i), domain, unit, problems);
        }
    } else if constexpr (is_variant<T>) {
        std::visit(
            [&](const auto& alternative) {
                check_domains(alternative, place, domain, unit, problems);
            },
            value);
    } else if constexpr (Described<T>) {
        for_each_field<T>([&](const auto& field) {
            check_domains(
                value.*field.member, place.child(field.name), field.domain, field.unit, problems);
        });
    }
}

}  // namespace grainbench::io
