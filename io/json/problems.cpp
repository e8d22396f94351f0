#include "io/json/problems.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grainbench::io {

namespace {

/// More problems than this are counted, not listed: nobody reads them.
constexpr std::size_t listed_problems = 20;

std::string where_text(const std::string& document, const std::string& pointer) {
    const std::string place = pointer.empty() ? "the top level" : pointer;
    return document.empty() ? place : document + ": " + place;
}

/// Edit distance with swaps of neighbours (optimal string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) {
        last[j] = j;
    }
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                row[j] = std::min(row[j], before[j - 2] + 1);
            }
        }
        std::swap(before, last);
        std::swap(last, row);
    }
    return last[b.size()];
}

}  // namespace

std::string pointer_step(std::string_view key) {
    std::string step = "/";
    for (const char c : key) {
        if (c == '~') {
            step += "~0";
        } else if (c == '/') {
            step += "~1";
        } else {
            step += c;
        }
    }
    return step;
}

std::string Place::pointer() const {
    if (parent_ == nullptr) {
        return "";
    }
    return parent_->pointer() + (is_index_ ? fmt::format("/{}", index_) : pointer_step(key_));
}

void Problems::raise_if_any(const std::string& document) const {
    if (problems_.empty()) {
        return;
    }
    const Problem& first = problems_.front();
    std::string what = first.what;
    if (problems_.size() > 1) {
        what = fmt::format("{} problems", problems_.size());
        for (std::size_t i = 0; i < std::min(problems_.size(), listed_problems); ++i) {
            const Problem& p = problems_[i];
            what += fmt::format("\n  {}: {}", p.pointer.empty() ? "/" : p.pointer, p.what);
        }
        if (problems_.size() > listed_problems) {
            what += fmt::format("\n  and {} more", problems_.size() - listed_problems);
        }
    }
    throw_bad_input({.what = what,
                     .where = where_text(document, first.pointer),
                     .likely_cause = first.likely_cause,
                     .next_step = first.next_step});
}

std::string_view nearest_name(std::string_view name, std::span<const std::string_view> known) {
    constexpr std::size_t longest = 64;  // nothing longer is a slip; bounds the time on junk
    if (name.size() > longest) {
        return {};
    }
    std::string_view nearest;
    std::size_t fewest = std::max<std::size_t>(2, name.size() / 3) + 1;
    for (const std::string_view candidate : known) {
        const std::size_t edits = edit_distance(name, candidate);
        if (edits < fewest && edits < candidate.size()) {
            fewest = edits;
            nearest = candidate;
        }
    }
    return nearest;
}

std::string list_names(std::span<const std::string_view> names) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i > 0) {
            text += i + 1 == names.size() ? " or " : ", ";
        }
        text += fmt::format("'{}'", names[i]);
    }
    return text;
}

std::string domain_text(const Domain& domain, std::string_view unit) {
    std::string text;
    if (std::isfinite(domain.low)) {
        text = fmt::format("{} {}", domain.low_open ? ">" : ">=", domain.low);
    }
    if (std::isfinite(domain.high)) {
        text += fmt::format(
            "{}{} {}", text.empty() ? "" : " and ", domain.high_open ? "<" : "<=", domain.high);
    }
    if (text.empty()) {
        text = "any value";
    }
    if (!unit.empty() && unit != "1") {
        text += fmt::format(" [{}]", unit);
    }
    return text;
}

Problem out_of_domain(std::string pointer,
                      double value,
                      const Domain& domain,
                      std::string_view unit) {
    return {
        .pointer = std::move(pointer),
        .what = fmt::format("{} is out of range; allowed: {}", value, domain_text(domain, unit)),
        .likely_cause = "a wrong sign, or a number in another unit (all units are SI)",
        .next_step = "give a number that is allowed"};
}

Problem unknown_name(std::string pointer,
                     std::string_view kind,
                     std::string_view name,
                     std::span<const std::string_view> known) {
    const std::string_view nearest = nearest_name(name, known);
    return {
        .pointer = std::move(pointer),
        .what = known.empty() ? fmt::format("no {} '{}': the scene has no {}", kind, name, kind)
                              : fmt::format("no {} '{}'; known: {}", kind, name, list_names(known)),
        .likely_cause = nearest.empty() ? fmt::format("the {} is missing or has another name", kind)
                                        : fmt::format("misspelt; did you mean '{}'?", nearest),
        .next_step = fmt::format("name an existing {}, or add this one", kind)};
}

}  // namespace grainbench::io
