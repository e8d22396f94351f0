/// Markdown page of any described struct: one table for each object. Internal to io and render.
#pragma once

#include "core/describe.hpp"
#include "core/types.hpp"

#include "io/json/field_writer.hpp"
#include "io/json/problems.hpp"
#include "io/json/type_traits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace grainbench::io {

inline std::string anchor(std::string_view name) {
    std::string text(name);
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) {
        return static_cast<char>(std::tolower(c));
    });
    return text;
}

/// A vertical bar would end a cell of a table.
inline std::string cell(std::string_view text) {
    std::string escaped;
    for (const char c : text) {
        escaped += c == '|' ? "\\|" : std::string(1, c);
    }
    return escaped;
}

/// Writes one section for each struct, an owner before its members.
class ReferenceBuilder {
public:
    /// \param preamble Markdown in front of the tables
    explicit ReferenceBuilder(std::string_view preamble) : text_(preamble) {}

    template <Described T>
    void add_section(std::string_view discriminator) {
        const std::string name(type_name<T>());
        if (!written_.insert(name).second) {
            return;
        }
        std::string rows;
        std::vector<std::function<void()>> later;
        if constexpr (Keyed<T>) {
            rows += fmt::format("| `{}` | string |  | required | `\"{}\"` | chooses this |\n",
                                discriminator,
                                T::key);
        }
        for_each_field<T>([&](const auto& field) { rows += row(field, later); });
        text_ += fmt::format("\n## {}\n\n", name);
        text_ += rows.empty() ? "Has no keys.\n"
                              : "| key | type | unit | default | allowed | meaning |\n"
                                "|---|---|---|---|---|---|\n" +
                                    rows;
        for (const auto& section : later) {
            section();
        }
    }

    const std::string& text() const { return text_; }

private:
    using Later = std::vector<std::function<void()>>;

    template <class Owner, class Member>
    std::string row(const Field<Owner, Member>& field, Later& later) {
        return fmt::format("| `{}` | {} | {} | {} | {} | {} |\n",
                           field.name,
                           type_text<Member>(later),
                           field.unit,
                           default_text(field),
                           allowed_text<Member>(field.domain),
                           cell(field.doc));
    }

    template <class T>
    std::string type_text(Later& later) {
        if constexpr (std::same_as<T, bool>) {
            return "true or false";
        } else if constexpr (std::same_as<T, std::string>) {
            return "string";
        } else if constexpr (std::floating_point<T>) {
            return "number";
        } else if constexpr (std::integral<T>) {
            return "whole number";
        } else if constexpr (std::same_as<T, Vec3>) {
            return "vector";
        } else if constexpr (DescribedEnum<T>) {
            return "name";
        } else if constexpr (is_optional<T>) {
            return type_text<typename T::value_type>(later);
        } else if constexpr (is_vector<T>) {
            return "list of " + type_text<typename T::value_type>(later);
        } else if constexpr (is_variant<T>) {
            std::string text;
            for_each_alternative<T>([&]<class A>() {
                text += (text.empty() ? "" : " or ") + link<A>(fmt::format("`{}`", A::key));
                later.push_back([this] { add_section<A>(variant_discriminator<T>()); });
            });
            return text;
        } else {
            later.push_back([this] { add_section<T>({}); });
            return link<T>(type_name<T>());
        }
    }

    template <class T>
    static std::string link(std::string_view text) {
        return fmt::format("[{}](#{})", text, anchor(type_name<T>()));
    }

    template <class Owner, class Member>
    static std::string default_text(const Field<Owner, Member>& field) {
        if (field.is_required) {
            return "required";
        }
        const Owner defaults{};
        const Json value = write_value(defaults.*field.member);
        if (is_absent(defaults.*field.member, value)) {
            return "none";
        }
        if constexpr (is_variant<Member>) {
            return fmt::format(
                "`{}`",
                std::visit([]<class A>(const A&) { return A::key; }, defaults.*field.member));
        } else {
            return fmt::format("`{}`", value.dump());
        }
    }

    template <class T>
    static std::string allowed_text(const Domain& domain) {
        if constexpr (is_optional<T> || is_vector<T>) {
            return allowed_text<typename T::value_type>(domain);
        } else if constexpr (DescribedEnum<T>) {
            std::string names;
            for (const auto& entry : EnumNames<T>::value) {
                names += fmt::format("{}`\"{}\"`", names.empty() ? "" : ", ", entry.second);
            }
            return names;
        } else if constexpr (std::floating_point<T> || std::integral<T> || std::same_as<T, Vec3>) {
            const bool is_bounded = std::isfinite(domain.low) || std::isfinite(domain.high);
            return is_bounded ? domain_text(domain, "") : "";
        } else {
            return "";
        }
    }

    std::string text_;
    std::set<std::string> written_;
};

}  // namespace grainbench::io
