#include "io/atomic_file.hpp"
#include "io/json/scene_json.hpp"

#include "cli/check_report.hpp"

#include "tests/cli/invoke.hpp"
#include "tests/cli/scenes.hpp"
#include "tests/unit/io/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace grainbench::cli {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::Contains;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class CheckCommand : public testing::Test {
protected:
    CheckCommand() { io::write_file(folder_ / "cup.json", cup_scene); }

    Answer check(std::vector<std::string> more) const {
        std::vector<std::string> arguments{"check", (folder_ / "cup.json").string()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return invoke(arguments);
    }

    std::vector<std::string> warnings(std::vector<std::string> more) const {
        more.push_back("--json");
        return json::parse(check(std::move(more)).out).at("warnings");
    }

    TemporaryFolder folder_;
};

TEST_F(CheckCommand, PrintsWhatTheSceneTurnsOnAndCosts) {
    const Answer answer = check({});
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_THAT(answer.err, IsEmpty());
    EXPECT_THAT(
        answer.out,
        AllOf(ContainsRegex("coulomb_friction +/contact/friction\n"),
              ContainsRegex("sinusoid +/stages/1/motions/0/motion\n"),
              HasSubstr("realisation 1 of 2 (seed 7): 144 particles: bead placed 144 of 144"),
              HasSubstr("numbers of history per contact"),
              HasSubstr("sqrt(I / (k_s R^2))"),
              ContainsRegex("\nmemory: about [0-9]+ MB\n"),
              ContainsRegex("\ntime: about [0-9:]+ on [0-9]+ threads")));
    EXPECT_EQ(folder_.count(), 1U);  // writes nothing
}

TEST_F(CheckCommand, ListsWhatIsMeasured) {
    const Answer answer = check(
        {"--set",
         R"(/observables/coordination={})",
         "--set",
         R"(/observables/regions=[{"name":"r","shape":{"type":"box","low":[0,0,0],"high":[1,1,1]}}])",
         "--set",
         R"(/observables/coarse_graining={"box":{"low":[0,0,0],"high":[1,1,1]},"counts":[1,1,1],
             "reach":0.1})"});
    EXPECT_THAT(answer.out,
                AllOf(ContainsRegex("coordination +/observables/coordination\n"),
                      ContainsRegex("regions +/observables/regions\n"),
                      ContainsRegex("coarse_graining +/observables/coarse_graining\n"),
                      Not(HasSubstr("mixing"))));
}

TEST_F(CheckCommand, JsonHoldsTheNumbersAndAnEffectiveSceneThatReadsBack) {
    const Answer answer = check({"--json",
                                 "--set",
                                 "/timestep={\"type\":\"fixed\",\"value\":1e-5}",
                                 "--set",
                                 "/stages/1/duration=1000"});  // outlasts the trial
    ASSERT_EQ(answer.code, 0) << answer.err;
    const json data = json::parse(answer.out);
    const Scene scene = io::parse_scene(data.at("scene").dump(), folder_.path(), "effective");
    EXPECT_EQ(std::get<FixedTimestep>(scene.timestep).value, 1e-5);
    EXPECT_EQ(data.at("particles"), 144);
    const json& stage = data.at("stages").at(0);
    EXPECT_NEAR(stage.at("expected_cycles"), 1e4, 1.0);  // 0.1 s; one more where division rounds up
    // Two beads of 1.69646e-4 kg: pi sqrt(8.4823e-5 / 1e4) = 2.8934e-4 s; the mass has six digits.
    EXPECT_NEAR(stage.at("contact_times").at(0).at("duration"), 2.8934e-4, 1e-8);
    EXPECT_NEAR(stage.at("steps_per_contact"), 28.934, 1e-3);
    EXPECT_GT(data.at("trial").at("particle_steps_per_second"), 0.0);
    double shares = 0.0;
    for (const auto& [phase, share] : data.at("trial").at("shares").items()) {
        EXPECT_GE(share, 0.0) << phase;
        shares += share.get<double>();
    }
    EXPECT_NEAR(shares, 1.0, 1e-9);
    EXPECT_GT(data.at("memory_bytes"), 0.0);
    EXPECT_GT(data.at("expected_seconds"), 0.0);
}

TEST_F(CheckCommand, WarnsOfWhatCannotAct) {
    EXPECT_THAT(warnings({"--set", "/contact/friction/coefficient=0"}),
                Contains(AllOf(HasSubstr("/contact/friction"), HasSubstr("coefficient is 0"))));
    EXPECT_THAT(warnings({"--set", "/stages/1/motions/0/motion/velocity=[0,0,0]"}),
                Contains(HasSubstr("/stages/1/motions/0/motion")));
    EXPECT_THAT(warnings({"--set", "/output/frame_interval=3"}),
                Contains(HasSubstr("/output/frame_interval")));
    EXPECT_THAT(warnings({"--set",
                          R"(/groups=[{"name":"a","species":"bead"},{"name":"b"}])",
                          "--set",
                          R"(/observables/mixing={"first":"a","second":"b","cell":0.002})"}),
                Contains(HasSubstr("/observables/mixing/cell does nothing: cells smaller")));
    EXPECT_THAT(warnings({}), Not(Contains(HasSubstr("does nothing"))));
}

TEST_F(CheckCommand, WarnsOfFewStepsInAContact) {
    EXPECT_THAT(warnings({"--set", "/timestep={\"type\":\"fixed\",\"value\":3e-5}"}),
                Contains(HasSubstr("9.6 steps in the shortest contact")));
    EXPECT_THAT(warnings({"--set", "/timestep={\"type\":\"fixed\",\"value\":1.5e-5}"}), IsEmpty());
    EXPECT_THAT(warnings({"--set", "/timestep={\"type\":\"fixed\",\"value\":1e-3}"}),
                Contains(HasSubstr("above the single-contact limit")));
}

TEST_F(CheckCommand, ProposesSofterContactsWhereOverlapsAreSmall) {
    // A fall through the bed: the lattice is 4 layers of 8 mm, sqrt(2 9.8 0.024) = 0.69 m/s at most
    // with the jitter; bead on cup at k = 1e7: 0.69 sqrt(1.69646e-4 / 1e7) / 0.003 = 9.4e-4.
    const json stiff = json::parse(
        check({"--json", "--set", "/contact/stiffness/normal=1e7", "--set", "/stages/1/motions=[]"})
            .out);
    const json& softening = stiff.at("stages").at(0).at("softening");
    EXPECT_NEAR(softening.at("overlap_ratio"), 9.4e-4, 0.3e-4);
    EXPECT_EQ(softening.at("pair"), (json{"bead", "cup"}));
    const double speed_up = softening.at("speed_up");
    EXPECT_NEAR(speed_up, 0.01 / softening.at("overlap_ratio").get<double>(), 1e-9);
    EXPECT_NEAR(softening.at("stiffness_factor"), 1.0 / (speed_up * speed_up), 1e-9);
    EXPECT_THAT(check({"--set", "/contact/stiffness/normal=1e7"}).out,
                ContainsRegex("softness +overlaps up to 0.* times the stiffness makes it 1 %"));
    EXPECT_THAT(check({"--set", "/contact/stiffness/normal=100"}).out,
                Not(HasSubstr("times the stiffness")));
}

TEST_F(CheckCommand, WarnsOfWallsThatAreNarrowForTheirParticles) {
    // The cup is 80 mm wide: 13 beads of 6 mm, 6.7 of 12 mm.
    EXPECT_THAT(warnings({"--set",
                          "/particles/species/0/radius=0.006",
                          "--set",
                          "/particles/insertion/0/counts=[1,1,1]"}),
                Contains(HasSubstr("only 6.7 diameters of 'bead' fit across the wall 'cup'")));
    EXPECT_THAT(warnings({}), Not(Contains(HasSubstr("diameters"))));
}

TEST_F(CheckCommand, WarnsOfSearchIntervalsThatFindContactsLate) {
    const std::string fixed = "/timestep={\"type\":\"fixed\",\"value\":1e-5}";
    // The tolerance of 1.875e-4 m in N steps of 1e-5 s: 1.875 m/s for N = 10, 0.01875 for 1000.
    EXPECT_THAT(warnings({"--set",
                          fixed,
                          "--set",
                          "/detection/trigger={\"type\":\"interval\","
                          "\"cycles\":1000}"}),
                Contains(HasSubstr("approaches above 0.019 m/s may be found late")));
    EXPECT_THAT(warnings({"--set",
                          fixed,
                          "--set",
                          "/detection/trigger={\"type\":\"interval\","
                          "\"cycles\":10}"}),
                IsEmpty());
}

TEST_F(CheckCommand, BadSceneExitsWithTwo) {
    const Answer answer = check({"--set", "/stages=[]"});
    EXPECT_EQ(answer.code, 2);
    EXPECT_THAT(answer.out, IsEmpty());
    EXPECT_THAT(answer.err, HasSubstr("/stages"));
}

}  // namespace
}  // namespace grainbench::cli
