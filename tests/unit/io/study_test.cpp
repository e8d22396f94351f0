#include "io/study.hpp"

#include "io/atomic_file.hpp"

#include "tests/unit/io/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

namespace grainbench::io {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;

const std::filesystem::path source = GRAINBENCH_SOURCE_DIR;

json small_study() {
    return json::parse(R"({
      "format": "grainbench-study/1",
      "scene": "scene.json",
      "variants": [{"name": "a"}, {"name": "b", "set": ["/gravity/2=-5"]}],
      "reference": "a",
      "observable": {"type": "history_curve", "column": "kinetic_energy"},
      "margin": 0.1
    })");
}

class StudyFile : public testing::Test {
protected:
    std::string error_in(const json& study) const {
        write_file(folder_ / "study.json", study.dump());
        return error_of([&] { read_study(folder_ / "study.json"); });
    }

    TemporaryFolder folder_;
};

TEST_F(StudyFile, ReadsBackWhatItWrites) {
    write_file(folder_ / "study.json", small_study().dump());
    const Study study = read_study(folder_ / "study.json");
    EXPECT_EQ(study.realisations, 3);
    EXPECT_EQ(std::get<HistoryCurve>(study.observable).points, 20);
    write_file(folder_ / "again.json", write_study(study));
    EXPECT_EQ(write_study(read_study(folder_ / "again.json")), write_study(study));
}

TEST_F(StudyFile, NamesTheNearestKeyAndVariant) {
    json study = small_study();
    study["realisation"] = 4;
    EXPECT_THAT(error_in(study), AllOf(HasSubstr("'realisation'"), HasSubstr("'realisations'")));
    study = small_study();
    study["variants"][0]["name"] = "coarse";
    study["reference"] = "corse";
    EXPECT_THAT(error_in(study), AllOf(HasSubstr("/reference"), HasSubstr("'coarse'")));
}

TEST_F(StudyFile, RefusesWhatCannotBeCompared) {
    json study = small_study();
    study["variants"].erase(1);
    EXPECT_THAT(error_in(study), HasSubstr("at least two variants"));
    study = small_study();
    study["variants"][1]["name"] = "a";
    EXPECT_THAT(error_in(study), HasSubstr("two variants are called 'a'"));
    study = small_study();
    study["growth"] = {2, 8};
    EXPECT_THAT(error_in(study), AllOf(HasSubstr("/growth/1"), HasSubstr("more than 3")));
    study = small_study();
    study["observable"] = {{"type", "final_profile"}, {"low", 1.0}, {"high", 0.0}};
    EXPECT_THAT(error_in(study), HasSubstr("/observable/high"));
    study = small_study();
    study["margin"] = 0;
    EXPECT_THAT(error_in(study), HasSubstr("/margin"));
}

TEST_F(StudyFile, SaysWhatToDoWithAScene) {
    const std::string said =
        error_of([] { read_study(source / "presets" / "scenes" / "bne.json"); });
    EXPECT_THAT(said, AllOf(HasSubstr("a scene, not a study"), HasSubstr("--suggest")));
}

TEST(StudyAxes, AreCombined) {
    Study study;
    study.axes = {
        {.name = "k", .values = {{.name = "hard"}, {.name = "soft", .set = {"/k=1"}}}},
        {.name = "dt", .values = {{.name = "fine"}, {.name = "coarse", .set = {"/d=2"}}}}};
    const std::vector<StudyVariant> variants = variants_of(study);
    EXPECT_THAT(variants,
                ElementsAre(Field(&StudyVariant::name, "hard, fine"),
                            Field(&StudyVariant::name, "hard, coarse"),
                            Field(&StudyVariant::name, "soft, fine"),
                            Field(&StudyVariant::name, "soft, coarse")));
    EXPECT_THAT(variants[3].set, ElementsAre("/k=1", "/d=2"));
}

TEST(StudySchema, IsFresh) {
    EXPECT_EQ(read_file(source / "share" / "schema" / "study.schema.json"), study_schema())
        << "write it anew: grainbench schema study";
}

TEST(StudySchema, ReferencePageIsFresh) {
    EXPECT_EQ(read_file(source / "share" / "doc" / "study-reference.md"), study_reference())
        << "write it anew: grainbench schema study --markdown";
}

TEST(StudySchema, AcceptsEveryPreset) {
    const json text = json::parse(study_schema());
    const valijson::adapters::NlohmannJsonAdapter adapter(text);
    valijson::Schema schema;
    valijson::SchemaParser().populateSchema(adapter, schema);
    for (const auto& entry : std::filesystem::directory_iterator(source / "presets" / "studies")) {
        const json preset = json::parse(read_file(entry.path()));
        const valijson::adapters::NlohmannJsonAdapter document(preset);
        valijson::Validator validator;
        EXPECT_TRUE(validator.validate(schema, document, nullptr)) << entry.path();
        EXPECT_NO_THROW(read_study(entry.path())) << entry.path();
    }
}

}  // namespace
}  // namespace grainbench::io
