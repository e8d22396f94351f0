#include "io/json/field_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace grainbench::io {

namespace {

/// Doubles beyond this may stand for several integers.
constexpr double largest_exact_integer = 9007199254740992.0;

std::string expected_number(std::string_view noun, const Domain& domain, std::string_view unit) {
    return fmt::format("{}, {}", noun, domain_text(domain, unit));
}

}  // namespace

void FieldReader::wrong_type(const Json& json, const Place& place, const std::string& expected) {
    std::string cause = "a value of another type";
    if (json.is_null()) {
        cause = "null only removes a key of an extended scene; it has no meaning here";
    } else if (json.is_string()) {
        cause = "quotes around a value that needs none, or a value for another key";
    }
    problems_.add({.pointer = place.pointer(),
                   .what = fmt::format("{} is {}; expected {}",
                                       excerpt(json),
                                       json.is_number()    ? "a number"
                                       : json.is_boolean() ? "true or false"
                                       : json.is_array()   ? "a list"
                                       : json.is_object()  ? "an object"
                                       : json.is_string()  ? "a string"
                                                           : "null",
                                       expected),
                   .likely_cause = cause,
                   .next_step = "give " + expected});
}

void FieldReader::missing_key(const Place& place, std::string_view key, std::string_view doc) {
    problems_.add({.pointer = place.pointer() + pointer_step(key),
                   .what = fmt::format("the key '{}' is missing: {}", key, doc),
                   .likely_cause = "left out or misspelt",
                   .next_step = fmt::format("add '{}'", key)});
}

void FieldReader::refuse_unknown_keys(const Json& json,
                                      const Place& place,
                                      std::span<const std::string_view> known) {
    for (const auto& entry : json.items()) {
        if (std::find(known.begin(), known.end(), entry.key()) != known.end()) {
            continue;
        }
        const std::string_view nearest = nearest_name(entry.key(), known);
        std::string cause = "no such setting here; from an extended scene it is removed with null";
        if (entry.key() == "enabled") {
            cause = "presence is the switch: an effect is on if its key is there";
        } else if (!nearest.empty()) {
            cause = fmt::format("misspelt; did you mean '{}'?", nearest);
        }
        problems_.add(
            {.pointer = place.pointer() + pointer_step(entry.key()),
             .what =
                 known.empty()
                     ? fmt::format("unknown key '{}'; there are none here", entry.key())
                     : fmt::format("unknown key '{}'; known: {}", entry.key(), list_names(known)),
             .likely_cause = cause,
             .next_step = "correct or remove the key"});
    }
}

void FieldReader::read_bool(const Json& json, const Place& place, bool& out) {
    if (!json.is_boolean()) {
        wrong_type(json, place, "true or false");
        return;
    }
    out = json.get<bool>();
}

void FieldReader::read_string(const Json& json, const Place& place, std::string& out) {
    if (!json.is_string()) {
        wrong_type(json, place, "a string");
        return;
    }
    out = json.get<std::string>();
}

void FieldReader::read_number(const Json& json,
                              const Place& place,
                              const Domain& domain,
                              std::string_view unit,
                              double& out) {
    if (!json.is_number()) {
        wrong_type(json, place, expected_number("a number", domain, unit));
        return;
    }
    const double value = json.get<double>();
    if (!std::isfinite(value) || !domain.contains(value)) {
        problems_.add(out_of_domain(place.pointer(), value, domain, unit));
        return;
    }
    out = value;
}

void FieldReader::read_integer(const Json& json,
                               const Place& place,
                               const Domain& domain,
                               std::string_view unit,
                               std::int64_t& out) {
    const auto is_whole = [](double x) {
        return std::floor(x) == x && std::abs(x) <= largest_exact_integer;
    };
    // 1e5 is a whole number although JSON libraries call it a float.
    const bool fits =
        json.is_number_unsigned()
            ? json.get<std::uint64_t>() <= std::uint64_t{std::numeric_limits<std::int64_t>::max()}
            : json.is_number_integer() || (json.is_number_float() && is_whole(json.get<double>()));
    if (!fits) {
        wrong_type(json, place, expected_number("a whole number", domain, unit));
        return;
    }
    const std::int64_t value = json.is_number_float()
                                   ? static_cast<std::int64_t>(json.get<double>())
                                   : json.get<std::int64_t>();
    if (!domain.contains(static_cast<double>(value))) {
        problems_.add(out_of_domain(place.pointer(), static_cast<double>(value), domain, unit));
        return;
    }
    out = value;
}

void FieldReader::read_vec3(
    const Json& json, const Place& place, const Domain& domain, std::string_view unit, Vec3& out) {
    if (!json.is_array() || json.size() != 3) {
        wrong_type(json, place, "a list of three numbers [x, y, z]");
        return;
    }
    read_number(json[0], place.child(0), domain, unit, out.x);
    read_number(json[1], place.child(1), domain, unit, out.y);
    read_number(json[2], place.child(2), domain, unit, out.z);
}

std::optional<std::size_t> FieldReader::read_name(const Json& json,
                                                  const Place& place,
                                                  std::span<const std::string_view> names) {
    if (!json.is_string()) {
        wrong_type(json, place, "one of " + list_names(names));
        return std::nullopt;
    }
    const auto& name = json.get_ref<const std::string&>();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
        const std::string_view nearest = nearest_name(name, names);
        problems_.add({.pointer = place.pointer(),
                       .what = fmt::format("{} is none of {}", excerpt(json), list_names(names)),
                       .likely_cause = nearest.empty()
                                           ? "a name that grainbench does not know"
                                           : fmt::format("misspelt; did you mean '{}'?", nearest),
                       .next_step = "use one of the names"});
        return std::nullopt;
    }
    return static_cast<std::size_t>(found - names.begin());
}

std::optional<std::size_t> FieldReader::read_discriminator(
    const Json& json,
    const Place& place,
    std::string_view discriminator,
    std::span<const std::string_view> names) {
    if (!json.is_object()) {
        wrong_type(json, place, fmt::format("an object with the key '{}'", discriminator));
        return std::nullopt;
    }
    const auto found = json.find(discriminator);
    if (found == json.end()) {
        missing_key(place, discriminator, "one of " + list_names(names));
        return std::nullopt;
    }
    return read_name(*found, place.child(discriminator), names);
}

}  // namespace grainbench::io
