/// What is wrong with a document, gathered so that one run of the program shows all of it: places
/// as JSON pointers, problems, and the error made of them.
#pragma once

#include "core/describe.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace grainbench::io {

/// Place in a document, kept as a chain on the stack; text is made only for a message.
/// A child must not outlive its parent, nor the key it was made with.
class Place {
public:
    Place() = default;

    Place child(std::string_view key) const& { return Place(this, key, 0, false); }

    Place child(std::size_t index) const& { return Place(this, {}, index, true); }

    // A child of a temporary would outlive it.
    Place child(std::string_view key) const&& = delete;
    Place child(std::size_t index) const&& = delete;

    /// JSON pointer (RFC 6901); empty for the whole document.
    std::string pointer() const;

private:
    Place(const Place* parent, std::string_view key, std::size_t index, bool is_index)
        : parent_(parent), key_(key), index_(index), is_index_(is_index) {}

    const Place* parent_ = nullptr;
    std::string_view key_;
    std::size_t index_ = 0;
    bool is_index_ = false;
};

/// `key` as one step of a JSON pointer, with its leading slash.
std::string pointer_step(std::string_view key);

struct Problem {
    std::string pointer;
    std::string what;
    std::string likely_cause;
    std::string next_step;
};

class Problems {
public:
    void add(Problem problem) { problems_.push_back(std::move(problem)); }

    bool empty() const { return problems_.empty(); }

    std::size_t size() const { return problems_.size(); }

    /// Throws Error(bad_input) with all problems, if there are any.
    /// \param document name of what was read, for the message
    void raise_if_any(const std::string& document) const;

private:
    std::vector<Problem> problems_;
};

/// The known name with the fewest edits (insert, delete, replace, swap) from `name`; empty if none
/// is near enough to be a slip of the keys.
std::string_view nearest_name(std::string_view name, std::span<const std::string_view> known);

/// "'a', 'b' or 'c'"
std::string list_names(std::span<const std::string_view> names);

/// "> 0 and <= 1 [m]"; "any value [m]" for an unbounded domain.
std::string domain_text(const Domain& domain, std::string_view unit);

/// Problem of a number outside its domain.
Problem out_of_domain(std::string pointer,
                      double value,
                      const Domain& domain,
                      std::string_view unit);

/// Problem of a name that refers to nothing.
/// \param kind what it should name: "species", "wall", ...
Problem unknown_name(std::string pointer,
                     std::string_view kind,
                     std::string_view name,
                     std::span<const std::string_view> known);

}  // namespace grainbench::io
