#include "core/error.hpp"

#include "io/json/document.hpp"
#include "io/json/problems.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>
#include <vector>

namespace grainbench::io {

namespace {

/// Scenes nest about 8 deep; the limit keeps junk from exhausting the stack of the recursive
/// readers.
constexpr std::size_t deepest_nesting = 64;

/// Word of the text around an offset, to recognise NaN and its kin.
std::string word_at(std::string_view text, std::size_t offset) {
    const auto is_word = [&](std::size_t i) {
        return std::isalnum(static_cast<unsigned char>(text[i])) != 0 || text[i] == '-' ||
               text[i] == '+' || text[i] == '.';
    };
    std::size_t first = std::min(offset, text.size());
    while (first > 0 && is_word(first - 1)) {
        --first;
    }
    std::size_t last = first;
    while (last < text.size() && is_word(last)) {
        ++last;
    }
    return std::string(text.substr(first, last - first));
}

bool is_nan_or_infinity(std::string word) {
    std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) {
        return static_cast<char>(std::tolower(c));
    });
    if (!word.empty() && (word[0] == '-' || word[0] == '+')) {
        word.erase(0, 1);
    }
    return word == "nan" || word == "inf" || word == "infinity";
}

/// Text of a library message without its prefix "[json...] parse error at line 1, column 2: ".
std::string plain_message(std::string message) {
    if (const auto bracket = message.find("] "); bracket != std::string::npos) {
        message.erase(0, bracket + 2);
    }
    if (message.starts_with("parse error")) {
        if (const auto colon = message.find(": "); colon != std::string::npos) {
            message.erase(0, colon + 2);
        }
    }
    return message;
}

[[noreturn]] void throw_syntax_error(std::string_view text,
                                     const std::string& name,
                                     std::size_t position,
                                     const std::string& message) {
    const std::size_t offset = std::min(position > 0 ? position - 1 : 0, text.size());
    const std::string_view before = text.substr(0, offset);
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0
    const std::string word = word_at(text, offset);
    Diagnosis diagnosis{
        .what = plain_message(message),
        .where = fmt::format("{}: line {}, column {}", name, line, offset - line_start + 1),
        .likely_cause =
            "a comma, bracket or quote is missing or too many; JSON has "
            "no comments",
        .next_step = "correct the text there"};
    if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
        diagnosis.what = "the text is empty";
        diagnosis.likely_cause = "nothing was written to the file";
        diagnosis.next_step = "write a scene, or start from a preset";
    } else if (is_nan_or_infinity(word)) {
        diagnosis.what = fmt::format("{} is not a number", word);
        diagnosis.likely_cause = "a script wrote the result of a failed calculation";
        diagnosis.next_step = "give a finite number";
    } else if (message.find("overflow") != std::string::npos) {
        diagnosis.likely_cause = "a wrong exponent: the largest number is about 1.8e308";
        diagnosis.next_step = "give a finite number";
    }
    throw_bad_input(std::move(diagnosis));
}

/// Builds the document and sees what the library's own builder hides: duplicate keys and depth.
class DocumentBuilder : public nlohmann::json_sax<Json> {
public:
    DocumentBuilder(std::string_view text, const std::string& name) : text_(text), name_(name) {}

    Json finish() {
        problems_.raise_if_any(name_);
        return std::move(root_);
    }

    bool null() override { return add(nullptr); }

    bool boolean(bool value) override { return add(value); }

    bool number_integer(number_integer_t value) override { return add(value); }

    bool number_unsigned(number_unsigned_t value) override { return add(value); }

    bool number_float(number_float_t value, const string_t&) override { return add(value); }

    bool string(string_t& value) override { return add(std::move(value)); }

    bool binary(binary_t&) override { return false; }

    bool start_object(std::size_t) override { return open(Json::object()); }

    bool start_array(std::size_t) override { return open(Json::array()); }

    bool end_object() override { return close(); }

    bool end_array() override { return close(); }

    bool key(string_t& value) override {
        Level& level = levels_.back();
        level.key = value;
        if (!level.keys.insert(value).second) {
            problems_.add({.pointer = pointer() + pointer_step(value),
                           .what = fmt::format("the key '{}' stands twice in this object", value),
                           .likely_cause = "an entry was copied and not renamed",
                           .next_step = "keep one of the two"});
        }
        return true;
    }

    bool parse_error(std::size_t position,
                     const std::string&,
                     const nlohmann::detail::exception& error) override {
        throw_syntax_error(text_, name_, position, error.what());
    }

private:
    struct Level {
        Json* value;
        std::string key;
        std::unordered_set<std::string> keys;
    };

    std::string pointer() const {
        std::string text;
        for (std::size_t i = 0; i + 1 < levels_.size(); ++i) {
            const Level& level = levels_[i];
            text += level.value->is_array() ? fmt::format("/{}", level.value->size() - 1)
                                            : pointer_step(level.key);
        }
        return text;
    }

    Json* place(Json value) {
        if (levels_.empty()) {
            root_ = std::move(value);
            return &root_;
        }
        Level& level = levels_.back();
        if (level.value->is_array()) {
            level.value->push_back(std::move(value));
            return &level.value->back();
        }
        auto& entries = level.value->get_ref<Json::object_t&>();
        entries.push_back({level.key, std::move(value)});  // key() has looked for duplicates
        return &entries.back().second;
    }

    bool add(Json value) {
        place(std::move(value));
        return true;
    }

    bool open(Json value) {
        if (levels_.size() >= deepest_nesting) {
            throw_bad_input({.what = fmt::format("nested deeper than {} levels", deepest_nesting),
                             .where = name_,
                             .likely_cause = "not a scene, or a bracket is repeated",
                             .next_step = "look for a long run of brackets"});
        }
        Json* placed = place(std::move(value));
        levels_.push_back({placed, {}, {}});
        return true;
    }

    bool close() {
        levels_.pop_back();
        return true;
    }

    std::string_view text_;
    const std::string& name_;
    Json root_;
    std::vector<Level> levels_;
    Problems problems_;
};

/// Lists of plain values, such as vectors, stay on one line.
void write_pretty(const Json& value, std::size_t indent, std::string& text) {
    const auto plain_text = [](const Json& plain) {
        return plain.dump(-1, ' ', false, Json::error_handler_t::replace);
    };
    if (!value.is_structured() || value.empty()) {
        text += plain_text(value);
        return;
    }
    const bool is_short =
        value.is_array() && std::none_of(value.begin(), value.end(), [](auto& item) {
            return item.is_structured() && !item.empty();
        });
    const std::string line_break = is_short ? "" : "\n" + std::string(indent + 2, ' ');
    text += value.is_array() ? '[' : '{';
    std::string separator = line_break;
    for (const auto& item : value.items()) {
        text += separator;
        if (value.is_object()) {
            text += plain_text(item.key()) + ": ";
        }
        write_pretty(item.value(), indent + 2, text);
        separator = is_short ? ", " : "," + line_break;
    }
    if (!is_short) {
        text += '\n';
        text.append(indent, ' ');
    }
    text += value.is_array() ? ']' : '}';
}

}  // namespace

Json parse_text(std::string_view text, const std::string& name) {
    DocumentBuilder builder(text, name);
    Json::sax_parse(text, &builder);
    return builder.finish();
}

std::string excerpt(const Json& value) {
    constexpr std::size_t longest = 60;
    std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (text.size() > longest) {
        text = text.substr(0, longest) + "...";
    }
    return text;
}

std::string pretty_text(const Json& value) {
    std::string text;
    write_pretty(value, 0, text);
    return text + "\n";
}

}  // namespace grainbench::io
