#include "core/scene.hpp"

#include "io/json/reference_builder.hpp"
#include "io/json/schema.hpp"

namespace grainbench::io {

namespace {

constexpr std::string_view preamble =
    R"(# Scene reference

One JSON file describes a run. All numbers are in SI units. An effect is on if its key is there; there
are no switches. Unknown keys are errors. Vectors are lists of three numbers `[x, y, z]`.

A file may start from another one: `"extends": "other.json"`, relative to the file. Objects merge,
lists and everything else replace, `null` removes a key (RFC 7386). On the command line
`--set /contact/friction/coefficient=0.3` changes one value.

This page is made of the field tables of the program (`grainbench schema`); edit those, not this.
)";

}  // namespace

std::string scene_reference() {
    ReferenceBuilder builder(preamble);
    builder.add_section<Scene>({});
    return builder.text();
}

}  // namespace grainbench::io
