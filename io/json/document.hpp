/// JSON text to a document: strict parsing with duplicate keys refused, `extends`, and overrides
/// from the command line. Knows nothing of scenes but where they keep file names. Internal to io.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace grainbench::io {

/// Keeps the order of the file, so that messages and effective scenes follow it.
using Json = nlohmann::ordered_json;

/// A document and how to call it in messages ("child.json, which extends base.json").
struct Document {
    Json json;
    std::string name;
};

/// Parses strictly. Throws Error(bad_input) with line and column of a syntax error, or with the
/// JSON pointers of duplicate keys.
Json parse_text(std::string_view text, const std::string& name);

/// Reads a file and merges it onto what it extends (RFC 7386: objects merge, arrays and the rest
/// replace, null deletes). File names in a base are rewritten so that they hold from `file`'s
/// folder.
Document load_document(const std::filesystem::path& file);

/// The same for text, with `extends` relative to `directory`.
Document load_document(std::string_view text,
                       const std::filesystem::path& directory,
                       const std::string& name);

/// Applies "/json/pointer=value". The value is JSON, or a string if it is not; null deletes a key.
/// Missing keys are created, an array index must exist.
void apply_override(Json& document, std::string_view assignment);

/// Rewrites each file name of a scene, a look or a figure set ("$schema", the paths of imported
/// files, "run", the scenes of runs and the looks of figures).
void rewrite_paths(Json& scene, const std::function<std::string(const std::string&)>& rewrite);

/// Text of a value over several lines, indented by 2; numbers read back to the last bit.
std::string pretty_text(const Json& value);

/// Compact text of a value, shortened for a message.
std::string excerpt(const Json& value);

}  // namespace grainbench::io
