#include "io/json/scene_json.hpp"

#include "tests/unit/io/scene_testing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace grainbench {
namespace {

using testing::HasSubstr;
using namespace testing_support;

/// One breach of one rule: overrides of a preset, and the problem they must bring up.
struct Breach {
    const char* name;
    std::vector<std::string> overrides;
    std::string problem;  ///< "/pointer: text"
    const char* preset = "bne.json";
};

class SceneRules : public testing::TestWithParam<Breach> {};

TEST_P(SceneRules, NamePlaceAndReasonOfABreach) {
    const Breach& breach = GetParam();
    const auto error = error_of_preset(breach.preset, breach.overrides);
    ASSERT_TRUE(error) << "accepted";
    EXPECT_EQ(error->kind(), ErrorKind::bad_input);
    EXPECT_FALSE(error->diagnosis().likely_cause.empty());
    EXPECT_FALSE(error->diagnosis().next_step.empty());
    // One problem stands as text and place apart; several as a list of "place: text".
    const std::size_t colon = breach.problem.find(": ");
    const std::string place = breach.problem.substr(0, colon);
    EXPECT_THAT(error->what(), HasSubstr(place));
    EXPECT_THAT(error->what(), HasSubstr(breach.problem.substr(colon + 2)));
}

const Breach breaches[] = {
    {"Format", {"/format=grainbench-scene/9"}, "/format: 'grainbench-scene/9' is not"},
    {"NoStages", {"/stages=[]"}, "/stages: no stages"},
    {"SpeciesTwice",
     {"/particles/species/1/name=small"},
     "/particles/species/1/name: the name 'small' is taken"},
    {"EmptyName", {"/groups/0/name=\"\""}, "/groups/0/name: an empty name"},
    {"InsertionSpecies",
     {"/particles/insertion/0/species=smal"},
     "/particles/insertion/0/species: no species 'smal'; known: 'small' or 'large'"},
    {"PeriodicSwapped",
     {"/periodic={\"x\":{\"low\":1,\"high\":0}}"},
     "/periodic/x/high: 0 m is not above 'low', 1 m"},
    {"PeriodicNowhere", {"/periodic={}"}, "/periodic: no direction"},
    {"DrivenUnknown", {"/driven=[{\"group\":\"nobody\"}]"}, "/driven/0/group: no group 'nobody'"},
    {"ReleasedWhoIsFree",
     {"/stages/0/released=[\"small\"]"},
     "/stages/0/released/0: the group 'small' is not driven"},
    {"SourceSpecies",
     {"/particles/sources=[{\"name\":\"in\",\"species\":\"smal\",\"rate\":1,"
      "\"box\":{\"low\":[0,0,0],\"high\":[1,1,1]}}]"},
     "/particles/sources/0/species: no species 'smal'; known: 'small' or 'large'"},
    {"SourceTooThin",
     {"/particles/sources=[{\"name\":\"in\",\"species\":\"small\",\"rate\":1,"
      "\"box\":{\"low\":[0,0,0],\"high\":[1,1,0.001]}}]"},
     "/particles/sources/0/box: the box is 0.001 m thin"},
    {"SourceEndsFirst",
     {"/particles/sources=[{\"name\":\"in\",\"species\":\"small\",\"rate\":1,\"start\":2,"
      "\"end\":1,\"box\":{\"low\":[0,0,0],\"high\":[1,1,1]}}]"},
     "/particles/sources/0/end: 1 s is not after the start at 2 s"},
    {"SinkOfAll",
     {"/particles/sinks=[{\"name\":\"out\"}]"},
     "/particles/sinks/0: a sink without bounds"},
    {"SinkSwapped",
     {"/particles/sinks=[{\"name\":\"out\",\"low\":1,\"high\":0}]"},
     "/particles/sinks/0/high: 0 m is not above 'low', 1 m"},
    {"InsideNoWall",
     {"/particles/insertion/1/inside=box"},
     "/particles/insertion/1/inside: no wall 'box'; known: 'container'"},
    {"InsideOpenWall",
     {"/walls/0/shape={\"type\":\"plane\",\"point\":[0,0,0],\"normal\":[0,0,1]}"},
     "/particles/insertion/0/inside: the wall 'container' encloses nothing"},
    {"BoxFlat",
     {"/particles/insertion/0/box/high/2=-0.07"},
     "/particles/insertion/0/box/high/2: -0.07 m is not above"},
    {"BoxTooThin",
     {"/particles/insertion/1/box/high/2=-0.09"},
     "/particles/insertion/1/box: the box is 0.01"},
    {"LatticeCounts",
     {"/particles/insertion/0/counts=[7, 7]"},
     "/particles/insertion/0/counts: 2 numbers; expected 3",
     "column-collapse.json"},
    {"LatticeSpacing",
     {"/particles/insertion/0/spacing/1=0"},
     "/particles/insertion/0/spacing/1: 0 m between 12 spheres",
     "column-collapse.json"},
    {"LatticeHuge",
     {"/particles/insertion/0/counts=[100000, 100000, 100000]"},
     "/particles/insertion/0/counts: 1e+15 spheres",
     "column-collapse.json"},
    {"RemovalSwapped",
     {"/particles/removal/0/high=-1"},
     "/particles/removal/0/high: -1 m is not above",
     "calibration.json"},
    {"WallTwice",
     {"/walls/1/name=left"},
     "/walls/1/name: the name 'left' is taken",
     "newtons-cradle.json"},
    {"WallNamedAsSpecies",
     {"/walls/0/name=ball"},
     "/walls/0/name: 'ball' is also the name of a species",
     "newtons-cradle.json"},
    {"NormalZero",
     {"/walls/0/shape/normal=[0, 0, 0]"},
     "/walls/0/shape/normal: a direction of length 0",
     "bouncing-ball.json"},
    {"AxisZero", {"/walls/0/shape/axis=[0, 0, 0]"}, "/walls/0/shape/axis: a direction of length 0"},
    {"TriangleIndex",
     {"/walls/0/shape/triangles/3/1=21"},
     "/walls/0/shape/triangles/3/1: index 21, but there are 21 vertices",
     "ball-on-triangles.json"},
    {"TriangleCorners",
     {"/walls/0/shape/triangles/0=[0, 1, 2, 3]"},
     "/walls/0/shape/triangles/0: 4 indices; expected 3",
     "ball-on-triangles.json"},
    {"TriangleFlat",
     {"/walls/0/shape/triangles/0=[1, 2, 1]"},
     "/walls/0/shape/triangles/0: a triangle with two equal corners",
     "ball-on-triangles.json"},
    {"TableOrder",
     {R"(/walls/0/motion={"type":"table","times":[0,2,2],"speeds":[0,1,2]})"},
     "/walls/0/motion/times/2: 2 s does not come after 2 s"},
    {"TableStart",
     {R"(/walls/0/motion={"type":"table","times":[1,2],"speeds":[0,1]})"},
     "/walls/0/motion/times/0: the first time is 1 s"},
    {"TableLengths",
     {R"(/walls/0/motion={"type":"table","times":[0,1],"speeds":[0,1,2]})"},
     "/walls/0/motion/speeds: 3 speeds for 2 times"},
    {"RotationAxis",
     {R"(/stages/0/motions/0/motion={"type":"rotation","point":[0,0,0],"axis":[0,0,0],"rate":1})"},
     "/stages/0/motions/0/motion/axis: a direction of length 0"},
    {"MotionOfNoWall",
     {"/stages/1/motions/0/wall=contianer"},
     "/stages/1/motions/0/wall: no wall 'contianer'"},
    {"TwoMotions",
     {"/stages/0/motions/1/wall=container_side"},
     "/stages/0/motions/1/wall: a second motion for 'container_side'",
     "bne-frictionless-wall.json"},
    {"FrictionWithoutShear",
     {"/contact/stiffness/shear=0"},
     "/contact/stiffness: friction is on, but the shear stiffness is 0"},
    {"FrictionWithoutShearInAStage",
     {R"(/stages/1/contact={"stiffness":{"law":"deformability_stiffness","modulus":1e7,"ratio":0},
         "normal":{"law":"linear_spring"},"friction":{"law":"coulomb_friction","coefficient":1}})"},
     "/stages/1/contact/stiffness: friction is on"},
    {"HertzWithoutItsSpring",
     {R"(/contact/normal={"law":"linear_spring"})"},
     "/contact/normal: 'linear_spring' does not go with 'hertz_stiffness'",
     "rotating-drum.json"},
    {"HertzWithCoulomb",
     {R"(/contact/friction={"law":"coulomb_friction","coefficient":1})"},
     "/contact/friction: 'coulomb_friction' does not go with 'hertz_stiffness'",
     "rotating-drum.json"},
    {"ElasticMaterialUnknown",
     {"/contact/stiffness/materials/0/name=drun"},
     "/contact/stiffness/materials/0/name: no material 'drun'",
     "rotating-drum.json"},
    {"RollingWithoutFriction",
     {"/contact/friction=null"},
     "/contact/rolling: rolling resistance without friction",
     "rotating-drum.json"},
    {"CohesionOnIncrementalSpring",
     {R"(/contact/normal={"law":"incremental_spring"})"},
     "/contact/cohesion: cohesion does not go with 'incremental_spring'",
     "cohesive-heap.json"},
    {"CohesionBeyondDetection",
     {"/contact/cohesion/reach=0.001"},
     "/contact/cohesion: it reaches over 0.001 m, detection over",
     "cohesive-heap.json"},
    {"CohesionOfContactsOnOverlap",
     {"/detection/create_on_overlap=true"},
     "/contact/cohesion: cohesion acts over a gap",
     "cohesive-heap.json"},
    {"RestitutionTwice",
     {R"(/contact/damping={"law":"restitution_damping","restitution":0.5})"},
     "/contact/damping: 'restitution_damping' on a spring that has a restitution of its own",
     "yielding-drop.json"},
    {"RegionTwice",
     {R"(/observables/regions=[{"name":"a","shape":{"type":"box","low":[0,0,0],"high":[1,1,1]}},
         {"name":"a","shape":{"type":"box","low":[0,0,0],"high":[1,1,1]}}])"},
     "/observables/regions/1/name: the name 'a' is taken"},
    {"RegionWithADot",
     {"/observables/regions/0/name=upper.half"},
     "/observables/regions/0/name: 'upper.half' holds a dot",
     "rotating-drum.json"},
    {"RegionFlat",
     {"/observables/regions/0/shape/high/2=-1"},
     "/observables/regions/0/shape/high/2: -1 m is not above",
     "rotating-drum.json"},
    {"RegionAxis",
     {R"(/observables/regions/0/shape={"type":"cylinder","base":[0,0,0],"axis":[0,0,0],
         "radius":1,"height":1})"},
     "/observables/regions/0/shape/axis: a direction of length 0",
     "rotating-drum.json"},
    {"RegionByNoGroup",
     {"/groups=[]", "/observables/regions/0/by=group", "/observables/mixing=null"},
     "/observables/regions/0/by: there are no groups to count",
     "rotating-drum.json"},
    {"MixingOfNoGroup",
     {"/observables/mixing/second=rigth"},
     "/observables/mixing/second: no group 'rigth'",
     "rotating-drum.json"},
    {"MixingOfOneGroup",
     {"/observables/mixing/second=left"},
     "/observables/mixing/second: 'left' mixed with itself",
     "rotating-drum.json"},
    {"ReposeSwapped",
     {"/observables/repose/0/surface/to=-1"},
     "/observables/repose/0/surface/to: -1 m is not above 'from'",
     "rotating-drum.json"},
    {"ReposeHeapSwapped",
     {R"(/observables/repose/0/surface={"type":"heap","centre":[0,0,0],"inner":2,"outer":1})"},
     "/observables/repose/0/surface/outer: 1 m is not above 'inner'",
     "rotating-drum.json"},
    {"ReposeAlongGravity",
     {"/observables/repose/0/surface/along=[0,0,-2]"},
     "/observables/repose/0/surface/along: a direction without horizontal part",
     "rotating-drum.json"},
    {"GridBox",
     {"/observables/coarse_graining/box/high/0=-1"},
     "/observables/coarse_graining/box/high/0: -1 m is not above",
     "rotating-drum.json"},
    {"GridCounts",
     {"/observables/coarse_graining/counts=[3, 3]"},
     "/observables/coarse_graining/counts: 2 numbers; expected 3",
     "rotating-drum.json"},
    {"ReachPastThePeriod",
     {R"(/periodic={"y":{"low":0,"high":0.01}})"},
     "/observables/coarse_graining/reach: 0.012 m reach past a period of 0.01 m",
     "rotating-drum.json"},
    {"RegionLikeASink",
     {R"(/particles/sinks=[{"name":"upper half","box":{"low":[0,0,0],"high":[1,1,1]}}])"},
     "/observables/regions/0/name: 'upper half' is also the name of a source or sink",
     "rotating-drum.json"},
    {"GridHuge",
     {"/observables/coarse_graining/counts=[1000, 1000, 1000]"},
     "/observables/coarse_graining/counts: 1e+09 cells",
     "rotating-drum.json"},
    {"FieldIntervalWithoutFields",
     {"/observables/coarse_graining=null"},
     "/output/field_interval: there are no fields to write",
     "rotating-drum.json"},
    {"PairOfThree",
     {R"(/contact/pairs/0/between=["small", "large", "container_side"])"},
     "/contact/pairs/0/between: 3 names; expected 2",
     "bne-frictionless-wall.json"},
    {"PairUnknown",
     {"/contact/pairs/1/between/0=lrage"},
     "/contact/pairs/1/between/0: no material 'lrage'",
     "bne-frictionless-wall.json"},
    {"PairTwice",
     {R"(/contact/pairs/1/between=["container_side", "small"])"},
     "/contact/pairs/1/between: the pair 'container_side', 'small' stands twice",
     "bne-frictionless-wall.json"},
    {"PairOfWalls",
     {R"(/contact/pairs/1/between=["container_side", "container_caps"])"},
     "/contact/pairs/1/between: a pair of two walls",
     "bne-frictionless-wall.json"},
    {"PairIdle",
     {"/contact/pairs/0/friction=null"},
     "/contact/pairs/0: the pair changes nothing",
     "bne-frictionless-wall.json"},
    {"PairTurnsOn",
     {"/contact/friction=null"},
     "/contact/pairs/0/friction: 'coulomb_friction' is off in the scene",
     "bne-frictionless-wall.json"},
    {"PairOtherLaw",
     {R"(/contact/pairs/0/stiffness={"law":"deformability_stiffness","modulus":1e7})"},
     "/contact/pairs/0/stiffness: 'deformability_stiffness' here, but 'constant_stiffness'",
     "bne-frictionless-wall.json"},
    {"PairWithoutShear",
     {R"(/contact/pairs/0={"between":["small","small"],
         "stiffness":{"law":"constant_stiffness","normal":1e4}})"},
     "/contact/pairs/0/stiffness: friction is on, but the shear stiffness is 0",
     "bne-frictionless-wall.json"},
    {"GroupSpecies", {"/groups/1/species=lrage"}, "/groups/1/species: no species 'lrage'"},
    {"GroupBox",
     {R"(/groups/0/box={"low":[0,0,0],"high":[1,-1,1]})"},
     "/groups/0/box/high/1: -1 m is not above"},
    {"LayersOrder", {"/layers/edges/3=-0.01"}, "/layers/edges/3: -0.01 m after -0.03 m"},
    {"LayersFew", {"/layers/edges=[1]"}, "/layers/edges: 1 edges; expected at least 2"},
    {"ElevationGroup",
     {"/observables/elevation/upper=larg"},
     "/observables/elevation/upper: no group 'larg'"},
    {"ElevationSame",
     {"/observables/elevation/lower=large"},
     "/observables/elevation/lower: 'large' over itself"},
    {"TraceSpecies", {"/traces/0/species=dust"}, "/traces/0/species: no species 'dust'"},
    {"HistoryTwice",
     {"/output/history_cycles=10"},
     "/output/history_cycles: both history_interval and history_cycles"},
    {"HistoryTwiceInAStage",
     {"/stages/1/output/history_cycles=10"},
     "/stages/1/output/history_cycles: both history_interval and history_cycles"},
    {"AverageOfNothing",
     {"/observables/elevation=null"},
     "/stages/0/average_interval: there is no elevation to average"},
};

INSTANTIATE_TEST_SUITE_P(Breaches, SceneRules, testing::ValuesIn(breaches), [](const auto& breach) {
    return std::string(breach.param.name);
});

TEST(SceneRules, AllowFrictionOfZeroWithoutShearStiffness) {
    EXPECT_FALSE(error_of_preset(
        "bne.json", {"/contact/friction/coefficient=0", "/contact/stiffness/shear=0"}));
}

TEST(SceneRules, AllowAWallOfTheMaterialOfASpecies) {
    EXPECT_FALSE(error_of_preset("bne.json", {"/walls/0/material=small"}));
}

TEST(SceneValidate, ChecksDomainsOfASceneBuiltInCode) {
    Scene scene = io::read_scene(preset("bne.json"));
    io::validate_scene(scene);

    scene.particles.species[1].density = -1.0;
    scene.gravity->y = std::numeric_limits<double>::quiet_NaN();
    try {
        io::validate_scene(scene);
        FAIL() << "accepted";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("/gravity/1: nan is out of range"));
        EXPECT_THAT(error.what(), HasSubstr("/particles/species/1/density: -1 is out of range"));
    }
}

}  // namespace
}  // namespace grainbench
