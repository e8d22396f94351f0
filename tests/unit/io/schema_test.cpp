#include "io/json/schema.hpp"

#include "io/json/scene_json.hpp"

#include "tests/unit/io/scene_testing.hpp"

#include <gtest/gtest.h>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

namespace grainbench {
namespace {

using namespace testing_support;

/// The schema as another program would apply it.
class SceneSchema : public testing::Test {
protected:
    SceneSchema() {
        const auto json = nlohmann::json::parse(io::scene_schema());
        const valijson::adapters::NlohmannJsonAdapter adapter(json);
        valijson::SchemaParser().populateSchema(adapter, schema_);
    }

    bool accepts(const std::string& text) const {
        const auto json = nlohmann::json::parse(text);
        const valijson::adapters::NlohmannJsonAdapter adapter(json);
        valijson::Validator validator;
        return validator.validate(schema_, adapter, nullptr);
    }

private:
    valijson::Schema schema_;
};

TEST_F(SceneSchema, IsFresh) {
    EXPECT_EQ(text_of(std::filesystem::path(GRAINBENCH_SOURCE_DIR) / "share" / "schema" /
                      "scene.schema.json"),
              io::scene_schema())
        << "write it anew: grainbench schema scene";
}

TEST_F(SceneSchema, ReferencePageIsFresh) {
    EXPECT_EQ(text_of(std::filesystem::path(GRAINBENCH_SOURCE_DIR) / "share" / "doc" /
                      "scene-reference.md"),
              io::scene_reference())
        << "write it anew: grainbench schema scene";
}

TEST_F(SceneSchema, AcceptsEveryPresetAsWrittenAndAsResolved) {
    for (const auto& file : preset_files()) {
        EXPECT_TRUE(accepts(text_of(file))) << file;
        EXPECT_TRUE(accepts(io::write_scene(io::read_scene(file)))) << file;
    }
}

TEST_F(SceneSchema, AcceptsADocumentWithEveryKey) {
    EXPECT_TRUE(accepts(every_key().dump()));
}

TEST_F(SceneSchema, RefusesWhatTheReaderRefuses) {
    const std::vector<std::pair<std::string, std::string>> changes{
        {"/unknown", "1"},
        {"/gravity", "[0, 0]"},
        {"/contact/friction/coefficient", "-1"},
        {"/contact/friction/law", "\"colomb_friction\""},
        {"/contact/damping/mode", "1.5"},
        {"/particles/species/0/radius", "0"},
        {"/particles/insertion/0/box/low", "\"left\""},
        {"/walls/0/shape/part", "\"lid\""},
        {"/walls/0/shape/type", "\"sphere\""},
        {"/timestep", "{\"safety_factor\": 0.5}"},
        {"/observables/energy", "true"},
        {"/stages", "[]"},
        {"/format", "\"grainbench-scene/9\""},
        {"/realisations/count", "0"}};
    const Json bne = Json::parse(text_of(preset("bne.json")));
    for (const auto& [pointer, value] : changes) {
        Json broken = bne;
        broken[Json::json_pointer(pointer)] = Json::parse(value);
        EXPECT_FALSE(accepts(broken.dump())) << pointer;
        EXPECT_TRUE(error_of(broken)) << pointer;
    }
}

TEST_F(SceneSchema, RefusesAScenePatchWithAnUnknownKeyOrAWrongValue) {
    EXPECT_TRUE(accepts(R"({"extends": "bne.json", "traces": null,
                            "contact": {"friction": {"coefficient": 0.1}}})"));
    EXPECT_FALSE(accepts(R"({"extends": "bne.json", "tracers": null})"));
    EXPECT_FALSE(accepts(R"({"extends": "bne.json", "contact": {"friction": {"mu": 0.1}}})"));
    EXPECT_FALSE(accepts(R"({"extends": "bne.json",
                             "contact": {"friction": {"coefficient": -0.1}}})"));
    EXPECT_FALSE(accepts(R"({"extends": "bne.json", "walls": [{"name": "half a wall"}]})"));
}

}  // namespace
}  // namespace grainbench
