/// JSON Schema of any described struct. Internal to io.
#pragma once

#include "core/describe.hpp"
#include "core/types.hpp"

#include "io/json/document.hpp"
#include "io/json/field_writer.hpp"
#include "io/json/type_traits.hpp"

#include <cmath>
#include <concepts>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace grainbench::io {

/// Collects one definition for each struct. `Patch` twins describe what a file that extends another
/// may hold in the same place: any part of it, and null to remove a key.
class SchemaBuilder {
public:
    enum class Form { full, patch };

    /// Schema of a value of type T.
    template <class T>
    Json schema_of(const Domain& domain, Form form) {
        if constexpr (std::same_as<T, bool>) {
            return {{"type", "boolean"}};
        } else if constexpr (std::same_as<T, std::string>) {
            return {{"type", "string"}};
        } else if constexpr (std::floating_point<T>) {
            return number("number", domain);
        } else if constexpr (std::integral<T>) {
            return number("integer", domain);
        } else if constexpr (std::same_as<T, Vec3>) {
            return {{"type", "array"},
                    {"items", number("number", domain)},
                    {"minItems", 3},
                    {"maxItems", 3}};
        } else if constexpr (DescribedEnum<T>) {
            Json names = Json::array();
            for (const auto& entry : EnumNames<T>::value) {
                names.push_back(std::string(entry.second));
            }
            return {{"type", "string"}, {"enum", names}};
        } else if constexpr (is_optional<T>) {
            return schema_of<typename T::value_type>(domain, form);
        } else if constexpr (is_vector<T>) {
            // A patch replaces a list as a whole, so its items are complete.
            return {{"type", "array"},
                    {"items", schema_of<typename T::value_type>(domain, Form::full)}};
        } else if constexpr (is_variant<T>) {
            return form == Form::patch ? variant_patch<T>() : variant<T>();
        } else {
            static_assert(Described<T>, "no schema for this type of member");
            return form == Form::patch ? define_patch<T>() : define<T>({});
        }
    }

    /// Reference to the definition of T, which is made if it is not there.
    template <Described T>
    Json define(std::string_view discriminator) {
        const std::string name(type_name<T>());
        if (!definitions.contains(name)) {
            definitions[name] = Json();  // keeps the order: owners before members
            Json object = {{"type", "object"}, {"additionalProperties", false}};
            Json required = Json::array();
            Json properties = Json::object();
            if constexpr (Keyed<T>) {
                required.push_back(std::string(discriminator));
                properties[std::string(discriminator)] = {{"const", std::string(T::key)}};
            }
            for_each_field<T>([&](const auto& field) {
                properties[std::string(field.name)] = member(field, Form::full);
                if (field.is_required) {
                    required.push_back(std::string(field.name));
                }
            });
            object["properties"] = std::move(properties);
            if (!required.empty()) {
                object["required"] = std::move(required);
            }
            definitions[name] = std::move(object);
        }
        return {{"$ref", "#/definitions/" + name}};
    }

    template <Described T>
    Json define_patch() {
        const std::string name = std::string(type_name<T>()) + "Patch";
        if (!definitions.contains(name)) {
            definitions[name] = Json();
            Json properties = Json::object();
            for_each_field<T>([&](const auto& field) {
                properties[std::string(field.name)] = or_null(member(field, Form::patch));
            });
            definitions[name] = {{"type", "object"},
                                 {"additionalProperties", false},
                                 {"properties", std::move(properties)}};
        }
        return {{"$ref", "#/definitions/" + name}};
    }

    Json definitions = Json::object();

private:
    static Json number(std::string_view type, const Domain& domain) {
        Json schema = {{"type", std::string(type)}};
        if (std::isfinite(domain.low)) {
            schema[domain.low_open ? "exclusiveMinimum" : "minimum"] = domain.low;
        }
        if (std::isfinite(domain.high)) {
            schema[domain.high_open ? "exclusiveMaximum" : "maximum"] = domain.high;
        }
        return schema;
    }

    static Json or_null(Json schema) {
        return {{"anyOf", {std::move(schema), {{"type", "null"}}}}};
    }

    template <class Owner, class Member>
    Json member(const Field<Owner, Member>& field, Form form) {
        Json schema = schema_of<Member>(field.domain, form);
        if (schema.contains("$ref")) {
            // draft-07 ignores what stands beside $ref
            schema = {{"allOf", Json::array({std::move(schema)})}};
        }
        std::string text(field.doc);
        if (!field.unit.empty() && field.unit != "1") {
            text += " [" + std::string(field.unit) + "]";
        }
        schema["description"] = text;
        if (!field.is_required && form == Form::full) {
            const Owner defaults{};
            Json value = write_value(defaults.*field.member);
            if (!is_absent(defaults.*field.member, value)) {
                schema["default"] = std::move(value);
            }
        }
        return schema;
    }

    template <class Variant>
    Json variant() {
        Json choices = Json::array();
        for_each_alternative<Variant>(
            [&]<class A>() { choices.push_back(define<A>(variant_discriminator<Variant>())); });
        return {{"oneOf", std::move(choices)}};
    }

    /// A patch of a variant may hold keys of the old alternative (as null) and of the new one.
    template <class Variant>
    Json variant_patch() {
        Json names = Json::array();
        Json choices = Json::object();
        for_each_alternative<Variant>([&]<class A>() {
            names.push_back(std::string(A::key));
            for_each_field<A>([&](const auto& field) {
                Json& of_key = choices[std::string(field.name)];
                of_key.push_back(member(field, Form::patch));
            });
        });
        Json properties = Json::object();
        properties[std::string(variant_discriminator<Variant>())] = {{"enum", std::move(names)}};
        for (auto& [key, schemas] : choices.items()) {
            schemas.push_back({{"type", "null"}});
            properties[key] = {{"anyOf", std::move(schemas)}};
        }
        return {{"type", "object"},
                {"additionalProperties", false},
                {"properties", std::move(properties)}};
    }
};

/// The schema of a file that holds a T and may extend another; T names its format.
/// What a field table cannot say is changed in the "definitions" of the result.
template <Described T>
Json file_schema(SchemaBuilder& builder, std::string_view title, std::string_view description) {
    const std::string name(type_name<T>());
    const Json full = builder.define<T>({});
    const Json patch = builder.define_patch<T>();
    const std::string format(T::format_name);
    builder.definitions[name]["properties"]["format"]["const"] = format;
    Json& patch_keys = builder.definitions[name + "Patch"]["properties"];
    patch_keys["format"] = {{"const", format}};
    patch_keys["extends"] = {{"type", "string"},
                             {"description",
                              "file that this one changes, relative to this file; objects merge, "
                              "lists replace, null removes a key"}};
    return {{"$schema", "http://json-schema.org/draft-07/schema#"},
            {"title", std::string(title)},
            {"description", std::string(description)},
            {"type", "object"},
            {"if", {{"required", {"extends"}}}},
            {"then", patch},
            {"else", full},
            {"definitions", builder.definitions}};
}

}  // namespace grainbench::io
