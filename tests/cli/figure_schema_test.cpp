/// The schema of figure sets as an editor would apply it.
#include "io/atomic_file.hpp"

#include "cli/figures/figure_set.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include <filesystem>

namespace grainbench::cli {
namespace {

bool accepts(const nlohmann::json& set) {
    const auto json = nlohmann::json::parse(figure_set_schema());
    valijson::Schema schema;
    valijson::SchemaParser().populateSchema(valijson::adapters::NlohmannJsonAdapter(json), schema);
    valijson::Validator validator;
    return validator.validate(schema, valijson::adapters::NlohmannJsonAdapter(set), nullptr);
}

TEST(FigureSetSchema, AcceptsEveryPresetAndRefusesAMisspeltKey) {
    for (const auto& entry : std::filesystem::directory_iterator(
             std::string(GRAINBENCH_SOURCE_DIR) + "/presets/figures")) {
        auto set = nlohmann::json::parse(io::read_file(entry.path()));
        EXPECT_TRUE(accepts(set)) << entry.path();
        set["figures"][0]["captoin"] = "";
        EXPECT_FALSE(accepts(set)) << entry.path();
    }
}

}  // namespace
}  // namespace grainbench::cli
