/// Looks as files.
#include "core/error.hpp"

#include "io/atomic_file.hpp"

#include "render/look_json.hpp"

#include "tests/unit/io/temporary_folder.hpp"

#include <gmock/gmock.h>

namespace grainbench::render {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::filesystem::path source = GRAINBENCH_SOURCE_DIR;

std::string error_of(const std::string& text) {
    const TemporaryFolder folder;
    io::write_file(folder / "look.json", text);
    try {
        read_look(folder / "look.json");
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::bad_input);
        return error.what();
    }
    return "no error";
}

TEST(Look, SchemaAndReferencePageAreFresh) {
    EXPECT_EQ(io::read_file(source / "share" / "schema" / "render.schema.json"), look_schema())
        << "write it anew: grainbench schema render";
    EXPECT_EQ(io::read_file(source / "share" / "doc" / "look-reference.md"), look_reference())
        << "write it anew: grainbench schema render --markdown";
}

TEST(Look, SaysWhatIsWrongAndWhere) {
    EXPECT_THAT(error_of(R"({"format": "grainbench-render/1", "legende": {}})"),
                AllOf(HasSubstr("/legende"), HasSubstr("legend")));
    EXPECT_THAT(error_of(R"({"format": "grainbench-scene/1"})"),
                HasSubstr("this is a scene, not a look"));
    EXPECT_THAT(error_of(R"({"format": "grainbench-render/1", "camera": {"up": [0, 2, -0.3]}})"),
                HasSubstr("along its own up direction"));
    EXPECT_THAT(error_of(R"({"format": "grainbench-render/1", "particles": {"colour":
            {"type": "speed", "range": {"low": 1, "high": 1}},
            "filters": [{"type": "slice", "axis": "x", "low": 2, "high": 1}]}})"),
                AllOf(HasSubstr("/particles/colour/range"), HasSubstr("/particles/filters/0")));
}

TEST(Look, RunIsFoundFromTheFolderOfTheFile) {
    const TemporaryFolder folder;
    io::make_folder(folder / "looks");
    io::write_file(folder / "base.json",
                   R"({"format": "grainbench-render/1", "run": "out", "legend": {}})");
    io::write_file(folder / "looks" / "a.json", R"({"extends": "../base.json", "legend": null})");
    const Look look = read_look(folder / "looks" / "a.json", {});
    EXPECT_EQ(std::filesystem::path(look.run).lexically_normal(), folder / "out");
    EXPECT_FALSE(look.legend.has_value());
}

TEST(Look, DefaultTakesOverrides) {
    const std::vector<std::string> overrides{"/width=320", "/legend=null"};
    const Look look = default_look(false, overrides);
    EXPECT_EQ(look.width, 320);
    EXPECT_FALSE(look.legend.has_value());
    EXPECT_TRUE(std::holds_alternative<SpeciesColour>(look.particles->colour));
    EXPECT_TRUE(std::holds_alternative<LayerColour>(default_look(true).particles->colour));
}

}  // namespace
}  // namespace grainbench::render
