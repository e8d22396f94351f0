#include "io/atomic_file.hpp"
#include "io/hdf5/history.hpp"
#include "io/json/scene_json.hpp"
#include "io/vtk/frame_reader.hpp"
#include "io/vtk/pvd.hpp"

#include "tests/cli/invoke.hpp"
#include "tests/cli/scenes.hpp"
#include "tests/unit/io/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace grainbench::cli {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class RunCommand : public testing::Test {
protected:
    RunCommand() { io::write_file(folder_ / "cup.json", cup_scene); }

    Answer run(std::vector<std::string> more, const std::string& to = "run") const {
        std::vector<std::string> arguments{
            "run", (folder_ / "cup.json").string(), "-o", (folder_ / to).string()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return invoke(arguments);
    }

    json manifest(const std::string& of = "run") const {
        return json::parse(io::read_file(folder_ / of / "manifest.json"));
    }

    std::vector<std::string> hashes(const std::string& of) const {
        std::vector<std::string> found;
        const json data = manifest(of);
        for (const json& realisation : data.at("realisations")) {
            found.push_back(realisation.at("state_hash"));
        }
        EXPECT_EQ(found.size(), 2U);
        return found;
    }

    TemporaryFolder folder_;
};

TEST_F(RunCommand, TellsWhatWasPlacedAndWhatCameOut) {
    const Answer answer = run({"--history-csv"});
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_THAT(answer.out, IsEmpty());
    EXPECT_THAT(answer.err,
                AllOf(HasSubstr("realisation 2 (seed 8): 144 particles: bead placed 144 of 144"),
                      ContainsRegex("\n +1 +144 +[0-9]+ "),
                      ContainsRegex("finished after .* M particle-steps/s per thread")));
    EXPECT_TRUE(io::file_exists(folder_ / "run" / "history.csv"));
    const io::History history = io::read_history(folder_ / "run" / "history.h5");
    ASSERT_THAT(history.realisations, SizeIs(2));
    EXPECT_EQ(history.realisations[1].seed, 8);
    // The start, every 0.01 s, and the end; the last interval may end with the run.
    EXPECT_GE(history.realisations[0].history.rows(), 20U);
}

TEST_F(RunCommand, WritesTheFieldsThatAreAskedFor) {
    const Answer answer =
        run({"--quiet",
             "--set",
             R"(/observables/coarse_graining={"box":{"low":[-0.04,-0.04,0],"high":[0.04,0.04,0.1]},
                 "counts":[2,2,2],"reach":0.02})",
             "--set",
             "/output/field_interval=0.03"});
    ASSERT_EQ(answer.code, 0) << answer.err;
    // The start, 0.03 s, 0.06 s, 0.09 s of both stages of 0.1 s, and the end.
    EXPECT_THAT(io::read_pvd(folder_ / "run" / "realisation-2" / "fields.pvd"), SizeIs(8));
    EXPECT_TRUE(io::file_exists(folder_ / "run" / "realisation-2" / "fields_000007.vti"));
}

TEST_F(RunCommand, ManifestIsComplete) {
    const Answer answer = run({"--json", "--quiet", "--threads", "1"});
    EXPECT_THAT(answer.err, IsEmpty());
    const json data = json::parse(answer.out);
    EXPECT_EQ(data, manifest());
    for (const char* key : {"version", "git_hash", "compiler", "compiler_flags", "cpu", "isa"}) {
        EXPECT_FALSE(data.at(key).get<std::string>().empty()) << key;
    }
    EXPECT_THAT(data.at("compiler_flags").get<std::string>(), HasSubstr("-ffp-contract=off"));
    EXPECT_EQ(data.at("outcome"), "finished");
    EXPECT_EQ(data.at("threads"), 1);
    EXPECT_THAT(data.at("effects").get<std::vector<std::string>>(),
                ElementsAre("gravity",
                            "constant_stiffness",
                            "incremental_spring",
                            "coulomb_friction",
                            "viscous_damping",
                            "automatic_timestep",
                            "displacement_trigger",
                            "sinusoid",
                            "traces"));
    const json& first = data.at("realisations").at(0);
    EXPECT_EQ(first.at("seed"), 7);
    EXPECT_EQ(first.at("particles"), 144);
    EXPECT_EQ(first.at("insertion").at(0).at("placed"), 144);
    EXPECT_GT(first.at("cycles"), 100);
    EXPECT_GT(first.at("wall_seconds"), 0.0);
    EXPECT_GT(first.at("particle_steps_per_second"), 0.0);
    EXPECT_NEAR(first.at("summary").at("time"), 0.2, 1e-3);  // one step of some 1e-5 s at most
}

TEST_F(RunCommand, ThreadsDoNotChangeTheResult) {
    ASSERT_EQ(run({"--threads", "1"}, "one").code, 0);
    ASSERT_EQ(run({"--threads", "2"}, "two").code, 0);
    EXPECT_EQ(hashes("one"), hashes("two"));
    EXPECT_NE(hashes("one").at(0), hashes("one").at(1));
}

TEST_F(RunCommand, FinishedRunMayBeResumedAndStaysAsItIs) {
    ASSERT_EQ(run({}).code, 0);
    const std::vector<std::string> before = hashes("run");
    const Answer again = run({"--resume"});
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_EQ(hashes("run"), before);
    EXPECT_THAT(again.err, HasSubstr("realisation 1: goes on from 0.2"));
}

TEST_F(RunCommand, EffectiveSceneOfARunGivesTheSameRun) {
    ASSERT_EQ(run({"--set", "/contact/friction/coefficient=0.3"}).code, 0);
    const std::string again = (folder_ / "again").string();
    ASSERT_EQ(invoke({"run", (folder_ / "run" / "scene.json").string(), "-o", again}).code, 0);
    EXPECT_EQ(hashes("run"), hashes("again"));
    EXPECT_EQ(io::read_file(folder_ / "again" / "scene.json"),
              io::read_file(folder_ / "run" / "scene.json"));
}

TEST_F(RunCommand, RefusesAFolderThatHoldsARun) {
    ASSERT_EQ(run({"--set", "/stages/0/duration=0", "--set", "/stages/1/duration=0"}).code, 0);
    const std::string before = io::read_file(folder_ / "run" / "manifest.json");
    const Answer answer = run({});
    EXPECT_EQ(answer.code, 2);
    EXPECT_THAT(
        answer.err,
        ContainsRegex("holds a run already.*\n.*where: .*run\n.*\n.*next step: .*--resume"));
    EXPECT_EQ(io::read_file(folder_ / "run" / "manifest.json"), before);
}

TEST_F(RunCommand, RefusesToResumeWithAnotherScene) {
    ASSERT_EQ(run({}).code, 0);
    const Answer answer = run({"--resume", "--set", "/gravity/2=-5"});
    EXPECT_EQ(answer.code, 2);
    EXPECT_THAT(answer.err, HasSubstr("another scene"));
}

TEST_F(RunCommand, BadInputExitsWithTwoAndLeavesNoFolder) {
    const struct {
        std::string set;
        std::string said;
    } cases[] = {
        {"/contact/friction/coeficient=0.3",
         "unknown key 'coeficient'.*\n  where: .*/contact/friction/coeficient\n.*did you mean "
         "'coefficient'"},
        {"/particles/species/0/radius=-1", "/particles/species/0/radius"},
        {"/stages/1/motions/0/wall=\"cap\"", "cup"},
        {"gravity=1", "--set|gravity=1"},
    };

    for (const auto& [set, said] : cases) {
        const Answer answer = run({"--set", set});
        EXPECT_EQ(answer.code, 2) << set;
        EXPECT_THAT(answer.err, AllOf(ContainsRegex(said), HasSubstr("next step: "))) << set;
        EXPECT_FALSE(io::file_exists(folder_ / "run")) << set;
    }
}

TEST_F(RunCommand, SceneThatCannotBeBuiltLeavesNoFolder) {
    const Answer answer =
        run({"--set",
             "/groups=[{\"name\":\"a\",\"species\":\"bead\"},{\"name\":\"b\",\"box\":"
             "{\"low\":[5,5,5],\"high\":[6,6,6]}}]",
             "--set",
             "/observables={\"elevation\":{\"upper\":\"a\",\"lower\":\"b\"}}"});
    EXPECT_EQ(answer.code, 2);
    EXPECT_THAT(answer.err, HasSubstr("the group 'b' holds no particle"));
    EXPECT_FALSE(io::file_exists(folder_ / "run"));
}

TEST_F(RunCommand, FolderThatCannotBeMadeExitsWithFive) {
    const Answer answer = run({}, "cup.json/run");
    EXPECT_EQ(answer.code, 5);
    EXPECT_THAT(answer.err, AllOf(HasSubstr("cup.json/run"), HasSubstr("next step: ")));
}

TEST_F(RunCommand, UnstableRunExitsWithThreeAndShowsWhere) {
    // Two balls placed into each other, with a force between them that no number can hold.
    const Answer answer = run({"--set",
                               "/particles/insertion=[{\"type\":\"list\",\"particles\":["
                               "{\"species\":\"bead\",\"position\":[0,0,0.05]},"
                               "{\"species\":\"bead\",\"position\":[0,0,0.051]},"
                               "{\"species\":\"bead\",\"position\":[0.02,0,0.05]}]}]",
                               "--set",
                               "/contact/normal/law=\"linear_spring\"",
                               "--set",
                               "/contact/stiffness/normal=1e307",
                               "--set",
                               "/guards/overlap/action=\"ignore\"",
                               "--set",
                               "/guards/energy/action=\"ignore\"",
                               "--set",
                               "/timestep={\"type\":\"fixed\",\"value\":1e-5}"});
    EXPECT_EQ(answer.code, 3) << answer.err;
    EXPECT_THAT(answer.err,
                ContainsRegex("realisation [12] is unstable: particle [12] \\(bead\\).*\n.*where: "
                              ".*cycle [0-9]+, time .*\n.*likely cause: .*\n.*next step: "));
    EXPECT_EQ(manifest().at("outcome"), "unstable");
    EXPECT_THAT(manifest().at("message").get<std::string>(), HasSubstr("is unstable"));
    // The frame for looking has what can be drawn: the ball that had nothing to do with it.
    std::vector<std::size_t> last_sizes;
    for (const char* name : {"realisation-1", "realisation-2"}) {
        const auto place = folder_ / "run" / name;
        const auto frames = io::read_pvd(place / "particles.pvd");
        last_sizes.push_back(io::read_particles_frame(place / frames.back().file).size());
    }
    EXPECT_EQ(*std::min_element(last_sizes.begin(), last_sizes.end()), 1U);
}

}  // namespace
}  // namespace grainbench::cli
