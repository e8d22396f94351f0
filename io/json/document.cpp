#include "io/json/document.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <vector>

namespace grainbench::io {

namespace {

namespace fs = std::filesystem;

std::string read_file(const fs::path& file, const std::string& wanted_by) {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) {
        const std::string problem = fs::exists(file, error) ? "is not a file" : "does not exist";
        throw_bad_input({.what = fmt::format("'{}' {}", file.string(), problem),
                         .where = wanted_by,
                         .likely_cause = "a misspelt name, or another working folder",
                         .next_step = "check the path"});
    }
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    if (!stream || text.view().empty() != (fs::file_size(file, error) == 0)) {
        throw_input_output({.what = fmt::format("cannot read '{}'", file.string()),
                            .where = wanted_by,
                            .likely_cause = "no permission",
                            .next_step = "check the permissions of the file"});
    }
    return std::move(text).str();
}

/// Merges a document onto what it extends. `chain` holds the files that lead here.
Document resolve(Json json,
                 const std::string& name,
                 const fs::path& directory,
                 std::vector<fs::path>& chain) {
    if (!json.is_object()) {
        throw_bad_input({.what = fmt::format("the document is {}, not an object", excerpt(json)),
                         .where = name,
                         .likely_cause = "not a scene",
                         .next_step = "write one object: { ... }"});
    }
    const auto extends = json.find("extends");
    if (extends == json.end()) {
        return {std::move(json), name};
    }
    const std::string where = name + ": /extends";
    if (!extends->is_string()) {
        throw_bad_input({.what = fmt::format("{} is not a file name", excerpt(*extends)),
                         .where = where,
                         .likely_cause = "'extends' takes one file",
                         .next_step = "give the name of a scene, relative to this file"});
    }
    const fs::path base_name = extends->get<std::string>();
    const fs::path base_file = directory / base_name;
    const fs::path identity = fs::weakly_canonical(base_file);
    if (std::find(chain.begin(), chain.end(), identity) != chain.end()) {
        throw_bad_input({.what = fmt::format("'{}' extends itself", base_name.string()),
                         .where = where,
                         .likely_cause = "two scenes extend each other",
                         .next_step = "remove 'extends' from one of them"});
    }
    Json base_json = parse_text(read_file(base_file, where), base_file.string());
    chain.push_back(identity);
    Document base =
        resolve(std::move(base_json), base_file.string(), base_file.parent_path(), chain);
    const fs::path prefix = base_name.parent_path();
    rewrite_paths(base.json, [&](const std::string& path) {
        return (prefix / path).lexically_normal().generic_string();
    });
    json.erase("extends");
    base.json.merge_patch(json);
    return {std::move(base.json), name + ", which extends " + base.name};
}

void rewrite_at(Json& value,
                std::string_view key,
                const std::function<std::string(const std::string&)>& rewrite) {
    if (!value.is_object()) {
        return;
    }
    const auto found = value.find(key);
    if (found != value.end() && found->is_string() &&
        !found->get_ref<const std::string&>().empty()) {
        *found = rewrite(found->get_ref<const std::string&>());
    }
}

Json override_value(std::string_view text, const std::string& where) {
    try {
        return parse_text(text, where);
    } catch (const Error&) {
        const bool meant_as_json =
            !text.empty() && std::string_view("{[\"").find(text.front()) != std::string_view::npos;
        if (meant_as_json) {
            throw;
        }
        return std::string(text);
    }
}

[[noreturn]] void throw_bad_override(const std::string& where, const std::string& what) {
    throw_bad_input({.what = what,
                     .where = where,
                     .likely_cause = "the pointer does not fit the scene",
                     .next_step = "write /key/key=value or /list/0/key=value, as in "
                                  "/contact/friction/coefficient=0.3"});
}

/// Element of a list that a step of an override names.
Json& element_of(Json& list, const std::string& step, const std::string& where) {
    const bool is_index = !step.empty() && step.size() < 10 &&
                          step.find_first_not_of("0123456789") == std::string::npos;
    const std::size_t index = is_index ? std::stoul(step) : list.size();
    if (index >= list.size()) {
        throw_bad_override(where,
                           fmt::format("no element '{}' in a list of {}", step, list.size()));
    }
    return list[index];
}

}  // namespace

Document load_document(const fs::path& file) {
    Json json = parse_text(read_file(file, file.string()), file.string());
    std::vector<fs::path> chain{fs::weakly_canonical(file)};
    return resolve(std::move(json), file.string(), file.parent_path(), chain);
}

Document load_document(std::string_view text, const fs::path& directory, const std::string& name) {
    std::vector<fs::path> chain;
    return resolve(parse_text(text, name), name, directory, chain);
}

void rewrite_paths(Json& scene, const std::function<std::string(const std::string&)>& rewrite) {
    const auto each_in = [](Json& owner, std::string_view key, const auto& visit) {
        if (!owner.is_object()) {
            return;
        }
        const auto list = owner.find(key);
        if (list != owner.end() && list->is_array()) {
            for (Json& item : *list) {
                visit(item);
            }
        }
    };
    // A URL stays what it is.
    rewrite_at(scene, "$schema", [&](const std::string& name) {
        return name.find("://") == std::string::npos ? rewrite(name) : name;
    });
    rewrite_at(scene, "run", rewrite);  // of a look (render/look.hpp)
    each_in(scene, "runs", [&](Json& run) { rewrite_at(run, "scene", rewrite); });
    each_in(scene, "figures", [&](Json& figure) { rewrite_at(figure, "look", rewrite); });
    rewrite_at(scene, "scene", rewrite);  // of a study (io/study.hpp)
    each_in(scene, "walls", [&](Json& wall) {
        if (wall.is_object() && wall.contains("shape")) {
            rewrite_at(wall["shape"], "path", rewrite);
        }
    });
    if (scene.is_object() && scene.contains("particles")) {
        each_in(scene["particles"], "insertion", [&](Json& insertion) {
            rewrite_at(insertion, "path", rewrite);
        });
    }
}

void apply_override(Json& document, std::string_view assignment) {
    const std::string where = fmt::format("override '{}'", assignment);
    const std::size_t equals = assignment.find('=');
    if (!assignment.starts_with('/') || equals == std::string_view::npos) {
        throw_bad_override(where, "an override is a JSON pointer, '=' and a value");
    }
    std::vector<std::string> steps;
    try {
        const Json::json_pointer pointer{std::string(assignment.substr(0, equals))};
        for (Json::json_pointer rest = pointer; !rest.empty(); rest = rest.parent_pointer()) {
            steps.insert(steps.begin(), rest.back());
        }
    } catch (const Json::parse_error&) {
        throw_bad_override(where, "'~' in a JSON pointer is written ~0, and '/' in a key ~1");
    }
    const bool removes = assignment.substr(equals + 1) == "null";
    Json* target = &document;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (target->is_array()) {
            target = &element_of(*target, steps[i], where);
        } else if (target->is_object() || target->is_null()) {
            if (removes && !target->contains(steps[i])) {
                throw_bad_override(where, fmt::format("there is no key '{}' to remove", steps[i]));
            }
            if (removes && i + 1 == steps.size()) {
                target->erase(steps[i]);
                return;
            }
            target = &(*target)[steps[i]];
        } else {
            throw_bad_override(
                where,
                fmt::format(
                    "'{}' is looked for in {}, which has no keys", steps[i], excerpt(*target)));
        }
    }
    *target = override_value(assignment.substr(equals + 1), where);
}

}  // namespace grainbench::io
