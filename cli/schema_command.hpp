/// `grainbench schema`: what a file of the user may hold.
#pragma once

#include "cli/streams.hpp"

#include <string>
#include <vector>

namespace grainbench::cli {

struct SchemaArguments {
    std::string kind = "scene";  ///< one of schema_kinds()
    bool markdown = false;       ///< a page to read instead of JSON Schema
};

/// Kinds of files that there is a schema of.
std::vector<std::string> schema_kinds();

int schema_command(const SchemaArguments& arguments, const Streams& streams);

}  // namespace grainbench::cli
