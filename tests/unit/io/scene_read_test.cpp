#include "io/json/scene_json.hpp"

#include "tests/unit/io/scene_testing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace grainbench {
namespace {

using io::parse_scene;
using io::read_scene;
using io::write_scene;
using testing::ContainsRegex;
using testing::HasSubstr;
using namespace testing_support;

TEST(SceneRead, FillsEveryKindOfMember) {
    const Scene scene = parse_scene(every_key().dump(), import_folder(), "every_key.json");

    EXPECT_EQ(scene.title, "Every key");
    EXPECT_EQ(scene.gravity, (Vec3{0.5, -0.25, -9.5}));
    EXPECT_EQ(scene.particles.species.at(1).density, 7800.0);
    const auto& lattice = std::get<LatticeInsertion>(scene.particles.insertion.at(1));
    EXPECT_EQ(lattice.counts, (std::vector<std::int64_t>{2, 3, 1}));
    EXPECT_EQ(scene.particles.removal.at(0).axis, Axis::x);
    EXPECT_EQ(scene.walls.at(0).material, "rubber");
    EXPECT_EQ(std::get<FacetedCylinder>(scene.walls.at(4).shape).part, CylinderPart::open_top);
    EXPECT_TRUE(std::get<TableMotion>(scene.walls.at(4).motion).repeat);
    EXPECT_EQ(std::get<Triangles>(scene.walls.at(6).shape).vertices.at(2), (Vec3{0.0, 1.0, 0.5}));
    EXPECT_EQ(std::get<ViscousDamping::Params>(*scene.contact.damping).mode, 2);
    EXPECT_EQ(std::get<ScaledTimestep>(*scene.stages.at(1).timestep).value, 0.5);
    EXPECT_TRUE(scene.observables.energy.has_value());
}

TEST(SceneRead, KeepsDefaultsAndAbsenceOfWhatIsLeftOut) {
    const Scene scene = parse_scene(smallest_scene().dump(), "", "test");

    EXPECT_FALSE(scene.gravity.has_value());
    EXPECT_FALSE(scene.contact.friction.has_value());
    EXPECT_EQ(std::get<AutomaticTimestep>(scene.timestep).safety_factor, 0.8);
    EXPECT_EQ(scene.detection.tolerance, 0.0625);
    EXPECT_FALSE(scene.observables.energy.has_value());
    EXPECT_EQ(scene.realisations.seed, 10001);
}

TEST(SceneRead, TakesAWholeNumberInExponentForm) {
    Json document = every_key();
    document["particles"]["insertion"][0]["count"] = 1e5;
    const Scene scene = parse_scene(document.dump(), import_folder(), "test");
    EXPECT_EQ(std::get<RandomInsertion>(scene.particles.insertion.at(0)).count, 100000);
}

TEST(SceneRead, ImportsTheFilesThatASceneNames) {
    const Scene scene = parse_scene(every_key().dump(), import_folder(), "test");
    const auto& file = std::get<FileInsertion>(scene.particles.insertion.at(3));
    ASSERT_EQ(file.imported.size(), 1u);
    EXPECT_EQ(file.imported[0].species, "sand");
    EXPECT_EQ(std::get<MeshFile>(scene.walls.at(5).shape).triangles.size(), 1u);
}

TEST(SceneRead, ReadsThePresetsOfTheShakenContainerAsMeant) {
    const Scene all = read_scene(preset("bne-all.json"));
    EXPECT_EQ(std::get<FixedTimestep>(all.timestep).value, 2e-5);
    EXPECT_EQ(std::get<RemapInterval>(all.detection.trigger).cycles, 10);
    EXPECT_TRUE(all.detection.create_on_overlap);
    EXPECT_EQ(all.particles.species.size(), 2u);
    EXPECT_EQ(all.stages.size(), 2u);

    const Scene calibration = read_scene(preset("calibration.json"));
    EXPECT_EQ(calibration.stages.size(), 1u);
    EXPECT_TRUE(calibration.traces.empty());
    EXPECT_FALSE(calibration.output.trace_interval.has_value());
    EXPECT_EQ(calibration.particles.removal.size(), 2u);
}

// --- extends -------------------------------------------------------------------------------------

TEST(SceneExtends, MergesObjectsReplacesListsAndRemovesByNull) {
    const auto folder = test_folder();
    Json base = smallest_scene();
    base["gravity"] = {0, 0, -9.8};
    base["layers"] = {{"axis", "x"}, {"edges", {0, 1, 2}}};
    write_text(folder / "base.json", base.dump());
    write_text(folder / "middle.json", R"({"extends": "base.json", "title": "middle"})");
    write_text(folder / "child.json",
               R"({"extends": "middle.json", "gravity": null, "layers": {"edges": [5, 4]}})");

    const Scene scene = read_scene(folder / "child.json");

    EXPECT_EQ(scene.title, "middle");
    EXPECT_FALSE(scene.gravity.has_value());
    EXPECT_EQ(scene.layers.value().axis, Axis::x);
    EXPECT_EQ(scene.layers.value().edges, (std::vector<double>{5.0, 4.0}));
}

TEST(SceneExtends, RefusesACycle) {
    const auto folder = test_folder();
    write_text(folder / "a.json", R"({"extends": "b.json"})");
    write_text(folder / "b.json", R"({"extends": "./a.json"})");
    try {
        read_scene(folder / "a.json");
        FAIL() << "a cycle was accepted";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), ContainsRegex("'./a.json' extends itself"));
        EXPECT_THAT(error.diagnosis().where, HasSubstr("b.json: /extends"));
    }
}

TEST(SceneExtends, NamesAMissingBaseAndTheFileThatWantsIt) {
    const auto error = error_of(R"({"extends": "nowhere.json"})", test_folder());
    ASSERT_TRUE(error);
    EXPECT_EQ(error->kind(), ErrorKind::bad_input);
    EXPECT_THAT(error->what(), ContainsRegex("nowhere.json' does not exist"));
    EXPECT_EQ(error->diagnosis().where, "test.json: /extends");
}

TEST(SceneExtends, FindsTheFilesOfABaseInAnotherFolder) {
    const auto folder = import_folder();
    std::filesystem::create_directories(folder / "studies");
    write_text(folder / "base.json", every_key().dump());
    write_text(folder / "studies" / "child.json", R"({"extends": "../base.json"})");

    const Scene scene = read_scene(folder / "studies" / "child.json");

    EXPECT_EQ(std::get<FileInsertion>(scene.particles.insertion.at(3)).path, "../spheres.csv");
    EXPECT_EQ(std::get<MeshFile>(scene.walls.at(5).shape).path, "../hull.stl");
}

// --- overrides -----------------------------------------------------------------------------------

TEST(SceneOverride, ChangesNumbersStringsAndListsAndCreatesKeys) {
    const std::vector<std::string> overrides{"/contact/friction/coefficient=0.25",
                                             "/title=no quotes needed",
                                             "/gravity=[1, 2, 3]",
                                             "/walls/0/shape/radius=0.06",
                                             "/observables/energy={}",
                                             "/layers=null"};
    const Scene scene = read_scene(preset("bne.json"), overrides);

    EXPECT_EQ(std::get<CoulombFriction::Params>(*scene.contact.friction).coefficient, 0.25);
    EXPECT_EQ(scene.title, "no quotes needed");
    EXPECT_EQ(scene.gravity, (Vec3{1.0, 2.0, 3.0}));
    EXPECT_EQ(std::get<FacetedCylinder>(scene.walls.at(0).shape).radius, 0.06);
    EXPECT_TRUE(scene.observables.energy.has_value());
    EXPECT_FALSE(scene.layers.has_value());
}

TEST(SceneOverride, IsRefusedWhereThePointerDoesNotFit) {
    const std::vector<std::pair<std::string, std::string>> cases{
        {"/walls/7/name=x", "no element '7' in a list of 1"},
        {"/walls/-/name=x", "no element '-'"},
        {"/title/first=x", "which has no keys"},
        {"title=x", "an override is a JSON pointer"},
        {"/title", "an override is a JSON pointer"},
        {"/titel=null", "there is no key 'titel' to remove"},
        {"/gravity=[1, 2", "unexpected end of input"},
        {"/contact/frictoin/coefficient=0.3", "unknown key 'frictoin'"},
        {"/timestep/growth=NaN", "\"NaN\" is a string; expected a number, > 1"}};
    for (const auto& [assignment, message] : cases) {
        const auto error = error_of_preset("bne.json", {assignment});
        ASSERT_TRUE(error) << assignment;
        EXPECT_EQ(error->kind(), ErrorKind::bad_input);
        EXPECT_THAT(error->what(), HasSubstr(message)) << assignment;
    }
}

// --- messages ------------------------------------------------------------------------------------

TEST(SceneError, NamesTheNearestKnownKey) {
    Json document = smallest_scene();
    document["gravtiy"] = {0, 0, -9.8};
    const auto error = error_of(document);
    ASSERT_TRUE(error);
    EXPECT_THAT(error->what(), ContainsRegex("unknown key 'gravtiy'; known: .*'gravity'"));
    EXPECT_EQ(error->diagnosis().where, "test.json: /gravtiy");
    EXPECT_THAT(error->diagnosis().likely_cause, ContainsRegex("did you mean 'gravity'"));
    EXPECT_FALSE(error->diagnosis().next_step.empty());
}

TEST(SceneError, NamesTheNearestAlternative) {
    Json document = smallest_scene();
    document["timestep"] = {{"type", "automatik"}};
    const auto error = error_of(document);
    ASSERT_TRUE(error);
    EXPECT_THAT(error->what(),
                ContainsRegex("\"automatik\" is none of 'automatic', 'fixed' or 'scaled'"));
    EXPECT_EQ(error->diagnosis().where, "test.json: /timestep/type");
    EXPECT_THAT(error->diagnosis().likely_cause, ContainsRegex("did you mean 'automatic'"));
}

TEST(SceneError, TellsValueDomainAndUnitOfANumberOutOfRange) {
    Json document = smallest_scene();
    document["particles"]["species"][0]["radius"] = -0.01;
    const auto error = error_of(document);
    ASSERT_TRUE(error);
    EXPECT_THAT(error->what(), ContainsRegex("-0\\.01 is out of range; allowed: > 0 \\[m\\]"));
    EXPECT_EQ(error->diagnosis().where, "test.json: /particles/species/0/radius");
}

TEST(SceneError, TellsWhatWasExpectedInPlaceOfAWrongType) {
    Json document = smallest_scene();
    document["particles"]["species"][0]["density"] = "heavy";
    const auto error = error_of(document);
    ASSERT_TRUE(error);
    EXPECT_THAT(error->what(),
                ContainsRegex("\"heavy\" is a string; expected a number, > 0 "
                              "\\[kg/m\\^3\\]"));
}

TEST(SceneError, NamesAMissingKey) {
    Json document = smallest_scene();
    document["particles"]["species"][0].erase("radius");
    const auto error = error_of(document);
    ASSERT_TRUE(error);
    EXPECT_THAT(error->what(), ContainsRegex("the key 'radius' is missing: radius of the spheres"));
}

TEST(SceneError, ExplainsThatPresenceIsTheSwitch) {
    Json document = smallest_scene();
    document["observables"]["energy"]["enabled"] = false;
    const auto error = error_of(document);
    ASSERT_TRUE(error);
    EXPECT_THAT(error->what(), ContainsRegex("presence is the switch"));
}

TEST(SceneError, GivesLineAndColumnOfASyntaxError) {
    const auto error = error_of("{\n  \"format\": \"x\",\n  \"title\" 5\n}", test_folder());
    ASSERT_TRUE(error);
    EXPECT_EQ(error->diagnosis().where, "test.json: line 3, column 11");
}

TEST(SceneError, RefusesNumbersThatAreNone) {
    for (const std::string word : {"NaN", "nan", "Infinity", "-Infinity", "-inf"}) {
        const auto error = error_of("{\"gravity\": [0, 0, " + word + "]}", test_folder());
        ASSERT_TRUE(error) << word;
        EXPECT_THAT(error->what(), HasSubstr(word + " is not a number"));
        EXPECT_THAT(error->diagnosis().where, HasSubstr("line 1, column"));
    }
    const auto error = error_of("{\"gravity\": [0, 0, 1e999]}", test_folder());
    ASSERT_TRUE(error);
    EXPECT_THAT(error->what(), ContainsRegex("number overflow parsing '1e999'"));
}

TEST(SceneError, PointsAtADuplicateKey) {
    const auto error = error_of(R"({"a": [0, {"b~/": 1, "b~/": 2}]})", test_folder());
    ASSERT_TRUE(error);
    EXPECT_THAT(error->what(), ContainsRegex("the key 'b~/' stands twice"));
    EXPECT_EQ(error->diagnosis().where, "test.json: /a/1/b~0~1");
}

TEST(SceneError, ListsAllProblemsAtOnce) {
    Json document = smallest_scene();
    document["titel"] = "x";
    document["particles"]["species"][0]["radius"] = 0;
    document["stages"][0]["duration"] = "1 s";
    const auto error = error_of(document);
    ASSERT_TRUE(error);
    EXPECT_THAT(error->what(), ContainsRegex("3 problems"));
    for (const char* pointer :
         {"/titel: ", "/particles/species/0/radius: ", "/stages/0/duration: "}) {
        EXPECT_THAT(error->what(), HasSubstr(pointer));
    }
}

TEST(SceneError, IsBadInputForAMissingFileAFolderAndAnEmptyFile) {
    const auto folder = test_folder();
    write_text(folder / "empty.json", " \n");
    for (const auto& [file, message] : std::vector<std::pair<std::filesystem::path, std::string>>{
             {folder / "absent.json", "does not exist"},
             {folder, "is not a file"},
             {folder / "empty.json", "the text is empty"}}) {
        try {
            read_scene(file);
            FAIL() << file;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::bad_input);
            EXPECT_THAT(error.what(), HasSubstr(message));
        }
    }
}

TEST(SceneError, SaysWhatAFileOfAnotherKindIsFor) {
    for (const auto& [file, what, command] :
         {std::tuple{
              "../studies/stiffness.json", "this is a study, not a scene", "`grainbench study`"},
          std::tuple{"../figures/scenes.json",
                     "this is a set of figures, not a scene",
                     "`grainbench figures`"}}) {
        try {
            read_scene(preset(file));
            FAIL() << file;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::bad_input);
            EXPECT_EQ(error.diagnosis().what, what);
            EXPECT_THAT(error.diagnosis().next_step, HasSubstr(command));
        }
    }
}

TEST(SceneError, StopsAtHopelessNesting) {
    const auto error = error_of(std::string(100000, '['), test_folder());
    ASSERT_TRUE(error);
    EXPECT_THAT(error->what(), HasSubstr("nested deeper"));
}

// --- writing -------------------------------------------------------------------------------------

TEST(SceneWrite, ReadsBackTheSameForEveryPreset) {
    const auto files = preset_files();
    ASSERT_GE(files.size(), 15u);
    for (const auto& file : files) {
        const std::string once = write_scene(read_scene(file));
        EXPECT_EQ(write_scene(parse_scene(once, "", "written")), once) << file;
    }
}

TEST(SceneWrite, KeepsEveryKeyOfADocumentThatHasThemAll) {
    const auto folder = import_folder();
    const Json document = every_key();
    const Json written =
        Json::parse(write_scene(parse_scene(document.dump(), folder, "every_key.json")));
    // Added defaults are allowed; nothing of the document may be lost or changed.
    const Json flat = document.flatten();
    for (const auto& entry : flat.items()) {
        const Json::json_pointer pointer(entry.key());
        ASSERT_TRUE(written.contains(pointer)) << entry.key();
        if (entry.value().is_primitive() && !entry.value().is_null()) {
            EXPECT_EQ(written.at(pointer), entry.value()) << entry.key();
        }
    }
}

TEST(SceneWrite, KeepsEveryBitOfANumber) {
    Json document = smallest_scene();
    const double awkward[3] = {0.1 + 0.2, -4.9406564584124654e-324, 1.7976931348623157e308};
    document["gravity"] = awkward;
    const Scene scene =
        parse_scene(write_scene(parse_scene(document.dump(), "", "first")), "", "second");
    EXPECT_EQ(scene.gravity, (Vec3{awkward[0], awkward[1], awkward[2]}));
}

TEST(SceneWrite, WritesDefaultsButNotAbsence) {
    const Json written = Json::parse(write_scene(parse_scene(smallest_scene().dump(), "", "test")));
    EXPECT_EQ(written.at("timestep").at("safety_factor"), 0.8);
    for (const char* key : {"gravity", "walls", "observables", "traces", "layers", "title"}) {
        EXPECT_FALSE(written.contains(key)) << key;
    }
}

TEST(SceneWrite, FindsImportedFilesFromAnyFolderWhenGivenTheBase) {
    const auto folder = import_folder();
    const Scene scene = parse_scene(every_key().dump(), folder, "test");
    EXPECT_EQ(std::get<FileInsertion>(scene.particles.insertion.at(3)).path, "spheres.csv");

    std::filesystem::create_directories(folder / "run" / "deep");
    write_text(folder / "run" / "deep" / "scene.json", write_scene(scene, folder));
    const Scene again = read_scene(folder / "run" / "deep" / "scene.json");

    EXPECT_EQ(std::get<FileInsertion>(again.particles.insertion.at(3)).imported.size(), 1u);
    EXPECT_TRUE(
        std::filesystem::path(std::get<MeshFile>(again.walls.at(5).shape).path).is_absolute());
}

}  // namespace
}  // namespace grainbench
