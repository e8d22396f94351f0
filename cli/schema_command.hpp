/// `grainbench schema`: what a file of the user may hold.
#pragma once

#include "cli/streams.hpp"

namespace grainbench::cli {

struct SchemaArguments {
    bool markdown = false;  ///< a page to read instead of JSON Schema
};

int schema_command(const SchemaArguments& arguments, const Streams& streams);

}  // namespace grainbench::cli
