#include "io/text.hpp"

#include <array>
#include <charconv>

namespace grainbench::io {

namespace {

template <class Number>
std::string shortest_text(Number value) {
    std::array<char, 40> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    return {digits.data(), end};
}

}  // namespace

std::string to_text(double value) {
    return shortest_text(value);
}

std::string to_single_text(double value) {
    return shortest_text(static_cast<float>(value));
}

std::string to_hex(std::uint64_t value) {
    constexpr std::string_view symbols = "0123456789abcdef";
    std::string text(16, '0');
    for (auto digit = text.rbegin(); digit != text.rend(); ++digit, value >>= 4U) {
        *digit = symbols[value & 15U];
    }
    return text;
}

std::string padded(std::size_t number) {
    const std::string digits = std::to_string(number);
    return digits.size() < 6 ? std::string(6 - digits.size(), '0') + digits : digits;
}

std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) {
        return text;
    }
    std::string quoted = "\"";
    for (const char c : text) {
        quoted += c == '"' ? "\"\"" : std::string(1, c);
    }
    return quoted + "\"";
}

std::uint64_t fnv1a(std::string_view bytes, std::uint64_t start) {
    std::uint64_t hash = start;
    for (const char byte : bytes) {
        hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211ULL;
    }
    return hash;
}

}  // namespace grainbench::io
