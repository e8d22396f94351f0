#include "io/json/file_kind.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace grainbench::io {

namespace {

struct FileKind {
    std::string_view format;   ///< without its version
    std::string_view name;     ///< with its article
    std::string_view command;  ///< that takes such files
};

constexpr std::array kinds{FileKind{"grainbench-scene", "a scene", "grainbench run"},
                           FileKind{"grainbench-study", "a study", "grainbench study"},
                           FileKind{"grainbench-figures", "a set of figures", "grainbench figures"},
                           FileKind{"grainbench-render", "a look", "grainbench render --look"}};

const FileKind* kind_of(std::string_view format) {
    const auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const FileKind& one) {
        return one.format == format.substr(0, format.find('/'));
    });
    return kind == kinds.end() ? nullptr : &*kind;
}

}  // namespace

void refuse_other_kinds(const Document& document, std::string_view format) {
    const auto found = document.json.find("format");
    if (found == document.json.end() || !found->is_string()) {
        return;
    }
    const FileKind* const kind = kind_of(found->get_ref<const std::string&>());
    const FileKind* const wanted = kind_of(format);
    if (kind == nullptr || wanted == nullptr || kind == wanted) {
        return;
    }
    // The slip that is easiest to make.
    const bool wants_study_of_scene =
        kind->format == "grainbench-scene" && wanted->format == "grainbench-study";
    throw_bad_input(
        {.what = fmt::format("this is {}, not {}", kind->name, wanted->name),
         .where = document.name,
         .likely_cause = wants_study_of_scene ? "a study file names its scene under 'scene'"
                                              : "a file for another command",
         .next_step = wants_study_of_scene
                          ? std::string("`grainbench study --suggest` writes a study of it")
                          : fmt::format("hand it to `{}`", kind->command)});
}

}  // namespace grainbench::io
