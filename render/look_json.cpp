#include "render/look_json.hpp"

#include "io/json/field_writer.hpp"
#include "io/json/read_described.hpp"
#include "io/json/reference_builder.hpp"
#include "io/json/schema_builder.hpp"

#include <fmt/format.h>

namespace grainbench::render {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view preamble =
    R"(# Look reference

One JSON file says how `grainbench render` draws the particles of a run. What is absent is not drawn.
Unknown keys are errors. Vectors are lists of three numbers `[x, y, z]`.

A file may start from another one: `"extends": "other.json"`, relative to the file. Objects merge,
lists and everything else replace, `null` removes a key (RFC 7386). On the command line
`--set /camera/view_angle=30` changes one value.

This page is made of the field tables of the program (`grainbench schema render --markdown`); edit
those, not this. Examples are in `presets/render`, [rendering](rendering.md) shows them.
)";

void add(io::Problems& problems, std::string pointer, std::string what, std::string next_step) {
    problems.add({.pointer = std::move(pointer),
                  .what = std::move(what),
                  .likely_cause = "a slip of the keys",
                  .next_step = std::move(next_step)});
}

void check_range(const std::optional<Range>& range,
                 const std::string& pointer,
                 io::Problems& problems) {
    if (range && !(range->low < range->high)) {
        add(problems,
            pointer + "/range",
            fmt::format("the range from {} to {} is empty", range->low, range->high),
            "let low be less than high, or leave the range out");
    }
}

void check_box(const std::optional<Box>& box, const std::string& pointer, io::Problems& problems) {
    if (!box) {
        return;
    }
    const Vec3 extent = box->high - box->low;
    if (!(extent.x > 0.0 && extent.y > 0.0 && extent.z > 0.0)) {
        add(problems, pointer, "the box is empty", "let low be less than high on every axis");
    }
}

void check_colour(const ParticleColour& colour, io::Problems& problems) {
    std::visit(
        [&]<class A>(const A& chosen) {
            if constexpr (requires { chosen.range; }) {
                check_range(chosen.range, "/particles/colour", problems);
            }
        },
        colour);
}

void check_filter(const ParticleFilter& filter,
                  const std::string& pointer,
                  io::Problems& problems) {
    if (const auto* slice = std::get_if<SliceFilter>(&filter); slice && slice->low >= slice->high) {
        add(problems, pointer, "the slice is empty", "let low be less than high");
    }
    if (const auto* region = std::get_if<RegionFilter>(&filter)) {
        check_box(region->box, pointer + "/box", problems);
    }
}

/// What the field tables cannot say.
void check(const Look& look, const std::string& name) {
    io::Problems problems;
    if (norm(cross(look.camera.direction, look.camera.up)) <=
        1e-6 * norm(look.camera.direction) * norm(look.camera.up)) {
        add(problems,
            "/camera",
            "the camera looks along its own up direction",
            "let 'direction' and 'up' differ: [0, 0, -1] needs another 'up', such as [0, 1, 0]");
    }
    check_box(look.camera.fit, "/camera/fit", problems);
    if (look.walls) {
        check_box(look.walls->region, "/walls/region", problems);
    }
    if (look.particles) {
        check_colour(look.particles->colour, problems);
        for (std::size_t k = 0; k < look.particles->filters.size(); ++k) {
            check_filter(
                look.particles->filters[k], fmt::format("/particles/filters/{}", k), problems);
        }
    }
    if (look.traces) {
        std::visit(
            [&](const auto& colour) { check_range(colour.range, "/traces/colour", problems); },
            look.traces->colour);
    }
    problems.raise_if_any(name);
}

}  // namespace

Look read_look(const fs::path& file, std::span<const std::string> overrides) {
    Look look = io::read_described<Look>(file, overrides);
    check(look, file.string());
    if (!look.run.empty()) {
        look.run = (file.parent_path() / look.run).lexically_normal().string();
    }
    return look;
}

Look default_look(bool has_layers, std::span<const std::string> overrides) {
    Look look;
    look.particles.emplace();
    if (!has_layers) {
        look.particles->colour = SpeciesColour{};
    }
    look.walls.emplace();
    look.ambient_occlusion.emplace();
    look.legend.emplace();
    look.time_stamp.emplace();
    look.scale_bar.emplace();
    io::Document document{io::write_value(look), "the look of the command line"};
    Look changed = io::described_of<Look>(std::move(document), overrides);
    check(changed, "the look of the command line");
    return changed;
}

std::string look_schema() {
    io::SchemaBuilder builder;
    return io::pretty_text(io::file_schema<Look>(
        builder, "grainbench render", "Look of a picture of grainbench, in SI units"));
}

std::string look_reference() {
    io::ReferenceBuilder builder(preamble);
    builder.add_section<Look>({});
    return builder.text();
}

}  // namespace grainbench::render
