/// Small conversions between numbers and text that do not depend on the locale.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace grainbench::io {

/// Shortest text that reads back to the same number.
std::string to_text(double value);

/// Shortest text that reads back to the same number of single precision, as view files hold them.
std::string to_single_text(double value);

/// Sixteen hexadecimal digits.
std::string to_hex(std::uint64_t value);

/// Digits of `number`, filled up with zeros to at least six.
std::string padded(std::size_t number);

/// The text as one field of a CSV line, in quotes where it needs them.
std::string csv_field(const std::string& text);

inline constexpr std::uint64_t fnv1a_start = 14695981039346656037ULL;

/// FNV-1a, 64 bits: tells apart files and scenes, is no protection against intent.
std::uint64_t fnv1a(std::string_view bytes, std::uint64_t start = fnv1a_start);

}  // namespace grainbench::io
