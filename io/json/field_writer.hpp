/// Described structs to JSON, in the order of their field tables. Internal to io.
#pragma once

#include "core/describe.hpp"
#include "core/types.hpp"

#include "io/json/document.hpp"
#include "io/json/type_traits.hpp"

#include <string>
#include <variant>
#include <vector>

namespace grainbench::io {

/// True for what reads the same when its key is left out: absent options, and empty strings, lists
/// and objects that are not required.
template <class T>
bool is_absent(const T& value, const Json& json) {
    if constexpr (is_optional<T>) {
        return !value.has_value();
    } else {
        return json.is_string() ? json.get_ref<const std::string&>().empty() : json.empty();
    }
}

template <class T>
Json write_value(const T& value);

template <Described T>
void write_fields(const T& value, Json& json) {
    for_each_field<T>([&](const auto& field) {
        Json member = write_value(value.*field.member);
        if (field.is_required || !is_absent(value.*field.member, member)) {
            json[std::string(field.name)] = std::move(member);
        }
    });
}

template <class T>
Json write_value(const T& value) {
    if constexpr (std::same_as<T, Vec3>) {
        return Json::array({value.x, value.y, value.z});
    } else if constexpr (DescribedEnum<T>) {
        return std::string(name_of(value));
    } else if constexpr (is_optional<T>) {
        return value ? write_value(*value) : Json();
    } else if constexpr (is_vector<T>) {
        Json list = Json::array();
        for (const auto& item : value) {
            list.push_back(write_value(item));
        }
        return list;
    } else if constexpr (is_variant<T>) {
        Json json = Json::object();
        std::visit(
            [&]<class A>(const A& alternative) {
                json[std::string(variant_discriminator<T>())] = std::string(A::key);
                write_fields(alternative, json);
            },
            value);
        return json;
    } else if constexpr (Described<T>) {
        Json json = Json::object();
        write_fields(value, json);
        return json;
    } else {
        return Json(value);
    }
}

}  // namespace grainbench::io
