/// A file to a described struct that is no scene: looks, figure sets, studies. Internal to io and
/// the layers above it.
#pragma once

#include "core/describe.hpp"
#include "core/error.hpp"

#include "io/json/document.hpp"
#include "io/json/field_reader.hpp"
#include "io/json/file_kind.hpp"
#include "io/json/problems.hpp"

#include <filesystem>
#include <span>
#include <string>

namespace grainbench::io {

/// A document with overrides "/json/pointer=value" applied; T names its format. Throws
/// Error(bad_input) that lists every problem that the field table knows of.
template <Described T>
T described_of(Document document, std::span<const std::string> overrides) {
    for (const std::string& assignment : overrides) {
        apply_override(document.json, assignment);
    }
    refuse_other_kinds(document, T::format_name);
    T value;
    Problems problems;
    FieldReader(problems).read_struct(document.json, Place{}, {}, value);
    problems.raise_if_any(document.name);
    if (value.format != T::format_name) {
        throw_bad_input(
            {.what = "'" + value.format + "' is not '" + std::string(T::format_name) + "'",
             .where = document.name + ", /format",
             .likely_cause = "a file of another version, or a slip in the name of the format",
             .next_step = "hand in a file of the format " + std::string(T::format_name)});
    }
    return value;
}

/// The same for a file, which may use "extends".
template <Described T>
T read_described(const std::filesystem::path& file, std::span<const std::string> overrides = {}) {
    return described_of<T>(load_document(file), overrides);
}

}  // namespace grainbench::io
