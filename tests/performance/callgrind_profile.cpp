#include "tests/performance/callgrind_profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <vector>

namespace grainbench::test {
namespace {

/// "void a::f<T>(int)::{lambda}" becomes "a::f".
std::string short_name(std::string name) {
    name = name.substr(0, name.find_first_of("<("));
    const std::size_t space = name.find_last_of(' ');
    return space == std::string::npos ? name : name.substr(space + 1);
}

/// Names come once in full as "(7) name", later as "(7)".
class Names {
public:
    const std::string& resolve(const std::string& text) {
        const std::size_t end = text.find(')');
        std::string& name = names_[text.substr(0, end)];
        if (end != std::string::npos && end + 2 < text.size()) {
            name = short_name(text.substr(end + 2));
        }
        return name;
    }

private:
    std::map<std::string, std::string> names_;
};

bool is_cost(const std::string& line) {
    return !line.empty() && (std::isdigit(static_cast<unsigned char>(line[0])) != 0 ||
                             line[0] == '+' || line[0] == '-' || line[0] == '*');
}

}  // namespace

double CallgrindProfile::total() const {
    double sum = 0.0;
    for (const auto& [name, count] : instructions) {
        sum += count;
    }
    return sum;
}

CallgrindProfile read_callgrind(const std::filesystem::path& file) {
    CallgrindProfile profile;
    Names names;
    std::string function;
    bool is_call = false;  // the next cost is that of a callee
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        const std::string request = "desc: Trigger: Client Request: ";
        if (line.starts_with(request)) {
            profile.trigger = line.substr(request.size());
        } else if (line.starts_with("fn=")) {
            function = names.resolve(line.substr(3));
        } else if (line.starts_with("cfn=")) {
            names.resolve(line.substr(4));
        } else if (line.starts_with("calls=")) {
            is_call = true;
        } else if (is_cost(line)) {
            if (!is_call) {
                profile.instructions[function] += std::stod(line.substr(line.find(' ')));
            }
            is_call = false;
        }
    }
    return profile;
}

std::string describe_changes(const std::map<std::string, double>& before,
                             const std::map<std::string, double>& after) {
    struct Change {
        std::string name;
        double before, after;

        double size() const { return std::abs(after - before); }
    };

    std::map<std::string, Change> by_name;
    for (const auto& [name, count] : before) {
        by_name[name] = {name, count, 0.0};
    }
    for (const auto& [name, count] : after) {
        by_name.try_emplace(name, Change{name, 0.0, 0.0}).first->second.after = count;
    }
    std::vector<Change> changes;
    for (const auto& [name, change] : by_name) {
        changes.push_back(change);
    }
    std::sort(changes.begin(), changes.end(), [](const Change& a, const Change& b) {
        return a.size() > b.size();
    });
    std::string text;
    for (std::size_t k = 0; k < std::min<std::size_t>(changes.size(), 5); ++k) {
        if (changes[k].size() >= 0.05) {
            text += fmt::format("  {:+8.1f}  {} ({:.1f} -> {:.1f})\n",
                                changes[k].after - changes[k].before,
                                changes[k].name,
                                changes[k].before,
                                changes[k].after);
        }
    }
    return text;
}

}  // namespace grainbench::test
