#include "io/json/schema.hpp"

#include "core/scene.hpp"

#include "io/json/schema_builder.hpp"

namespace grainbench::io {

namespace {

/// Counts that the rules of a scene ask for and a field table cannot say.
void add_counts(Json& definitions) {
    const auto list_of = [&](const char* owner, const char* member) -> Json& {
        return definitions[owner]["properties"][member];
    };
    Json& counts = list_of("LatticeInsertion", "counts");
    counts["minItems"] = 3;
    counts["maxItems"] = 3;
    Json& between = list_of("PairContact", "between");
    between["minItems"] = 2;
    between["maxItems"] = 2;
    Json& triangles = list_of("Triangles", "triangles");
    triangles["minItems"] = 1;
    triangles["items"]["minItems"] = 3;
    triangles["items"]["maxItems"] = 3;
    list_of("Layers", "edges")["minItems"] = 2;
    list_of("TableMotion", "times")["minItems"] = 2;
    list_of("Scene", "stages")["minItems"] = 1;
}

}  // namespace

std::string scene_schema() {
    SchemaBuilder builder;
    Json schema =
        file_schema<Scene>(builder, "grainbench scene", "Scene of grainbench, in SI units");
    add_counts(schema["definitions"]);
    return pretty_text(schema);
}

}  // namespace grainbench::io
