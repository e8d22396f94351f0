/// JSON to described structs, for any field table. Strict: unknown keys, wrong types, missing keys
/// and numbers out of their domain become problems with their JSON pointer. Internal to io.
#pragma once

#include "core/describe.hpp"
#include "core/types.hpp"

#include "io/json/document.hpp"
#include "io/json/problems.hpp"
#include "io/json/type_traits.hpp"

#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace grainbench::io {

class FieldReader {
public:
    explicit FieldReader(Problems& problems) : problems_(problems) {}

    /// Reads `json` into `out`; where it does not fit, adds problems and leaves the default.
    template <class T>
    void read(
        const Json& json, const Place& place, const Domain& domain, std::string_view unit, T& out) {
        if constexpr (std::same_as<T, bool>) {
            read_bool(json, place, out);
        } else if constexpr (std::same_as<T, std::string>) {
            read_string(json, place, out);
        } else if constexpr (std::floating_point<T>) {
            read_number(json, place, domain, unit, out);
        } else if constexpr (std::same_as<T, std::int64_t>) {
            read_integer(json, place, domain, unit, out);
        } else if constexpr (std::same_as<T, Vec3>) {
            read_vec3(json, place, domain, unit, out);
        } else if constexpr (DescribedEnum<T>) {
            read_enum(json, place, out);
        } else if constexpr (is_optional<T>) {
            read(json, place, domain, unit, out.emplace());
        } else if constexpr (is_vector<T>) {
            read_vector(json, place, domain, unit, out);
        } else if constexpr (is_variant<T>) {
            read_variant(json, place, out);
        } else if constexpr (Described<T>) {
            read_struct(json, place, {}, out);
        } else {
            static_assert(!is_unknown<T>, "no reader for this type of member");
        }
    }

    /// Reads an object. `discriminator` is a key that the caller has read, or empty.
    template <Described T>
    void read_struct(const Json& json, const Place& place, std::string_view discriminator, T& out) {
        if (!json.is_object()) {
            wrong_type(json, place, "an object");
            return;
        }
        refuse_unknown_keys(json, place, known_keys<T>(discriminator));
        for_each_field<T>([&](const auto& field) {
            const auto found = json.find(field.name);
            if (found != json.end()) {
                read(*found, place.child(field.name), field.domain, field.unit, out.*field.member);
            } else if (field.is_required) {
                missing_key(place, field.name, field.doc);
            }
        });
    }

private:
    void read_bool(const Json& json, const Place& place, bool& out);
    void read_string(const Json& json, const Place& place, std::string& out);
    void read_number(const Json& json,
                     const Place& place,
                     const Domain& domain,
                     std::string_view unit,
                     double& out);
    void read_integer(const Json& json,
                      const Place& place,
                      const Domain& domain,
                      std::string_view unit,
                      std::int64_t& out);
    void read_vec3(const Json& json,
                   const Place& place,
                   const Domain& domain,
                   std::string_view unit,
                   Vec3& out);

    /// Index of the name that `json` holds, if it is one.
    std::optional<std::size_t> read_name(const Json& json,
                                         const Place& place,
                                         std::span<const std::string_view> names);

    /// The same for the key that tells which alternative of a variant an object is.
    std::optional<std::size_t> read_discriminator(const Json& json,
                                                  const Place& place,
                                                  std::string_view discriminator,
                                                  std::span<const std::string_view> names);

    void wrong_type(const Json& json, const Place& place, const std::string& expected);
    void missing_key(const Place& place, std::string_view key, std::string_view doc);
    void refuse_unknown_keys(const Json& json,
                             const Place& place,
                             std::span<const std::string_view> known);

    template <Described T>
    static std::vector<std::string_view> known_keys(std::string_view discriminator) {
        std::vector<std::string_view> names;
        if (!discriminator.empty()) {
            names.push_back(discriminator);
        }
        for_each_field<T>([&](const auto& field) { names.push_back(field.name); });
        return names;
    }

    template <class T>
    void read_enum(const Json& json, const Place& place, T& out) {
        std::vector<std::string_view> names;
        for (const auto& entry : EnumNames<T>::value) {
            names.push_back(entry.second);
        }
        if (const auto index = read_name(json, place, names)) {
            out = EnumNames<T>::value[*index].first;
        }
    }

    template <class T>
    void read_vector(const Json& json,
                     const Place& place,
                     const Domain& domain,
                     std::string_view unit,
                     std::vector<T>& out) {
        if (!json.is_array()) {
            wrong_type(json, place, "a list [...]");
            return;
        }
        out.clear();
        out.resize(json.size());
        for (std::size_t i = 0; i < json.size(); ++i) {
            read(json[i], place.child(i), domain, unit, out[i]);
        }
    }

    template <class Variant>
    void read_variant(const Json& json, const Place& place, Variant& out) {
        constexpr std::string_view discriminator = variant_discriminator<Variant>();
        std::vector<std::string_view> names;
        for_each_alternative<Variant>([&]<class A>() { names.push_back(A::key); });
        const auto chosen = read_discriminator(json, place, discriminator, names);
        if (!chosen) {
            return;
        }
        std::size_t index = 0;
        for_each_alternative<Variant>([&]<class A>() {
            if (index++ == *chosen) {
                read_struct(json, place, discriminator, out.template emplace<A>());
            }
        });
    }

    Problems& problems_;
};

}  // namespace grainbench::io
