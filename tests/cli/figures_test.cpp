/// Figure sets: from a file to pictures and an index page, and again from the cache.
#include "io/atomic_file.hpp"
#include "io/json/scene_json.hpp"

#include "render/image.hpp"

#include "cli/figures/figure_chart.hpp"
#include "cli/figures/figure_index.hpp"
#include "cli/figures/figure_set.hpp"

#include "tests/cli/invoke.hpp"
#include "tests/cli/scenes.hpp"
#include "tests/unit/io/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace grainbench::cli {
namespace {

using testing::AllOf;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr double none = std::numeric_limits<double>::quiet_NaN();
// A few roundings of numbers of order one.
constexpr double round_off = 16.0 * std::numeric_limits<double>::epsilon();

/// Two runs of the cup, three charts and frames of one run.
constexpr const char* cup_set = R"({
  "format": "grainbench-figures/1",
  "title": "Balls in a cup & more",
  "quick": ["/stages/1/duration=0.02"],
  "runs": [
    {"name": "rough", "scene": "cup.json"},
    {"name": "smooth", "label": "less friction", "scene": "cup.json",
     "set": ["/contact/friction/coefficient=0.1"]}],
  "figures": [
    {"type": "chart", "name": "energy", "caption": "Kinetic energy < of both.",
     "x": {"label": "time", "unit": "ms", "factor": 1000},
     "y": {"label": "kinetic energy", "unit": "J"},
     "curves": [{"type": "history", "run": "rough", "column": "kinetic_energy", "show": "band"},
                {"type": "history", "run": "smooth", "column": "kinetic_energy",
                 "show": "realisations"}]},
    {"type": "chart", "name": "cycles", "caption": "Cycles.",
     "x": {"label": "run"}, "y": {"label": "cycles"},
     "curves": [{"type": "summary", "runs": ["rough", "smooth"], "quantity": "cycles"}]},
    {"type": "chart", "name": "wall", "caption": "Velocity of the cup.",
     "x": {"label": "time", "unit": "s"}, "y": {"label": "velocity", "unit": "m/s"},
     "curves": [{"type": "wall_velocity", "run": "rough", "wall": "cup", "stage": 1,
                 "duration": 0.05}]},
    {"type": "snapshot", "name": "cup", "caption": "The cup.", "run": "rough", "look": "look.json",
     "set": ["/width=160"], "times": [0, 0.1, 0.2], "quick_times": [0, 0.1]}]
})";

constexpr const char* small_look = R"({
  "format": "grainbench-render/1", "width": 320, "height": 100, "particles": {}, "walls": {}
})";

class Figures : public testing::Test {
protected:
    Figures() {
        io::write_file(folder_ / "cup.json", cup_scene);
        io::write_file(folder_ / "look.json", small_look);
        write_set(cup_set);
    }

    void write_set(const std::string& text) { io::write_file(folder_ / "set.json", text); }

    /// The set with its first figure only.
    void write_short_set() {
        const std::string text = cup_set;
        write_set(text.substr(0, text.find(",\n    {\"type\": \"chart\", \"name\": \"cycles\"")) +
                  "]}");
    }

    /// The set with one part of it replaced.
    void write_set_with(const std::string& before, const std::string& after) {
        std::string text = cup_set;
        const std::size_t at = text.find(before);
        ASSERT_NE(at, std::string::npos);
        write_set(text.replace(at, before.size(), after));
    }

    Answer draw(std::vector<std::string> more = {}) const {
        std::vector<std::string> arguments{
            "figures", (folder_ / "set.json").string(), "-o", (folder_ / "out").string()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return invoke(arguments);
    }

    std::string text(const std::string& file) const {
        return io::read_file(folder_ / "out" / file);
    }

    TemporaryFolder folder_;
};

TEST_F(Figures, LandAsPictureDrawingAndNumbersWithAnIndexPage) {
    const Answer answer = draw({"--quick"});
    ASSERT_EQ(answer.code, 0) << answer.err;
    for (const std::string name : {"energy", "cycles", "wall"}) {
        for (const std::string extension : {".png", ".svg", ".csv"}) {
            EXPECT_TRUE(io::file_exists(folder_ / "out/figures" / (name + extension))) << name;
        }
    }
    EXPECT_THAT(text("index.html"),
                AllOf(HasSubstr("Balls in a cup &amp; more"),
                      HasSubstr("Kinetic energy &lt; of both."),
                      HasSubstr("<img src=\"figures/energy.png\""),
                      HasSubstr("cup.json /contact/friction/coefficient=0.1"),
                      HasSubstr("<img src=\"figures/cup-0.1s.png\""),
                      HasSubstr("Made with --quick")));
    EXPECT_THAT(text("index.md"),
                AllOf(HasSubstr("![](figures/energy.png)"), HasSubstr("| finished |")));
    EXPECT_EQ(render::read_png(folder_ / "out/figures/cup-0.1s.png").size.width, 160);
    EXPECT_FALSE(io::file_exists(folder_ / "out/figures/cup-0.2s.png"));
    // Both realisations of one run, in the units of the axis: 0.12 s are 120 ms.
    EXPECT_THAT(text("figures/energy.csv"),
                AllOf(HasSubstr("less friction 2,"), HasSubstr(",120")));
    EXPECT_THAT(text("figures/cycles.csv"), HasSubstr("less friction,"));
}

TEST_F(Figures, AreDrawnAgainFromTheCacheToTheSameBytes) {
    write_short_set();
    ASSERT_EQ(draw({"--quick"}).code, 0);
    const std::string before = text("figures/energy.png");
    const std::string page = text("index.html");
    const Answer again = draw({"--quick", "--jobs", "1"});
    EXPECT_EQ(again.code, 0);
    EXPECT_THAT(again.err, HasSubstr("0 to do"));
    EXPECT_EQ(text("figures/energy.png"), before);
    EXPECT_EQ(text("index.html"), page);
}

TEST_F(Figures, RunOnlyWhatChanged) {
    write_short_set();
    ASSERT_EQ(draw({"--quick"}).code, 0);
    std::string text = io::read_file(folder_ / "set.json");
    const std::string before = "coefficient=0.1";
    write_set(text.replace(text.find(before), before.size(), "coefficient=0.2"));
    EXPECT_THAT(draw({"--quick"}).err, HasSubstr("1 to do"));
}

TEST_F(Figures, NameEveryMistakeOfASet) {
    write_set_with(R"("run": "smooth", "column")", R"("run": "smoth", "column")");
    EXPECT_THAT(draw().err, AllOf(HasSubstr("/figures/0/curves/1/run"), HasSubstr("smooth")));
    write_set_with(R"("name": "cycles", "caption")", R"("name": "energy", "caption")");
    EXPECT_THAT(draw().err, HasSubstr("the name 'energy' stands twice"));
    write_set_with(R"("name": "wall", "caption")", R"("name": "../wall", "caption")");
    EXPECT_THAT(draw().err, HasSubstr("'../wall' cannot be a name"));
    write_set_with(R"("quantity": "cycles")", R"("quantity": "cycles", "draw": "points")");
    EXPECT_THAT(draw().err, HasSubstr("0 numbers where 2 belong"));
    write_set_with(R"("times": [0, 0.1, 0.2])", R"("times": [])");
    EXPECT_THAT(draw().err, HasSubstr("no time is given"));
    write_set_with("grainbench-figures/1", "grainbench-scene/1");
    EXPECT_EQ(draw().code, 2);
    write_set_with(R"("scene": "cup.json"},)", R"("scene": "cap.json"},)");
    EXPECT_THAT(draw().err, HasSubstr("cap.json"));
}

TEST_F(Figures, NameAColumnOrAWallThatThereIsNot) {
    write_set_with(R"("column": "kinetic_energy", "show": "band")", R"("column": "energy")");
    const Answer answer = draw({"--quick"});
    EXPECT_EQ(answer.code, 2);
    EXPECT_THAT(answer.err,
                AllOf(HasSubstr("'energy'"), HasSubstr("figure 'energy'"), HasSubstr("kinetic_")));
    write_set_with(R"("wall": "cup", "stage": 1)", R"("wall": "cap", "stage": 1)");
    EXPECT_THAT(draw({"--quick"}).err, AllOf(HasSubstr("'cap'"), HasSubstr("figure 'wall'")));
}

TEST_F(Figures, NameALookThatThereIsNot) {
    write_set_with("look.json", "looks.json");
    const Answer answer = draw({"--quick"});
    EXPECT_EQ(answer.code, 2);
    EXPECT_THAT(answer.err, HasSubstr("looks.json"));
    EXPECT_THAT(answer.err, Not(HasSubstr("runs ended"))) << "it was said after the runs only";
}

TEST(FigureSchema, IsFresh) {
    const std::string share = std::string(GRAINBENCH_SOURCE_DIR) + "/share/";
    EXPECT_EQ(io::read_file(share + "schema/figures.schema.json"), figure_set_schema())
        << "write it anew: grainbench schema figures";
    EXPECT_EQ(io::read_file(share + "doc/figures-reference.md"), figure_set_reference())
        << "write it anew: grainbench schema figures --markdown";
    EXPECT_EQ(invoke({"schema", "figures"}).out, figure_set_schema());
}

TEST(FigurePreset, ReadsWithAllItsScenesQuickAndWhole) {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(
             std::string(GRAINBENCH_SOURCE_DIR) + "/presets/figures")) {
        const FigureSet set = read_figure_set(entry.path());
        for (const FigureRun& run : set.runs) {
            std::vector<std::string> changes = run.set;
            const auto scene = entry.path().parent_path() / run.scene;
            EXPECT_NO_THROW(io::read_scene(scene, changes)) << entry.path() << ": " << run.name;
            changes.insert(changes.end(), set.quick.begin(), set.quick.end());
            changes.insert(changes.end(), run.quick.begin(), run.quick.end());
            EXPECT_NO_THROW(io::read_scene(scene, changes)) << entry.path() << ": " << run.name;
        }
        ++count;
    }
    EXPECT_GT(count, 0);
}

TEST(FigurePreset, SmallSetIsDrawnQuickly) {
    const TemporaryFolder folder;
    const std::string set =
        std::string(GRAINBENCH_SOURCE_DIR) + "/presets/figures/calibration.json";
    const Answer answer = invoke({"figures", set, "--quick", "-o", folder.path().string()});
    EXPECT_EQ(answer.code, 0) << answer.err;
    // Softer spheres take fewer cycles: the rows are in the order of the stiffness.
    const std::string csv = io::read_file(folder / "figures/cycles.csv");
    std::vector<double> cycles;
    for (const std::string stiffness : {"10000", "1e+05", "1e+06"}) {
        const std::string row = "grainbench," + stiffness + ",";
        ASSERT_THAT(csv, HasSubstr(row));
        cycles.push_back(std::stod(csv.substr(csv.find(row) + row.size())));
    }
    EXPECT_LT(2.0 * cycles[0], cycles[1]);
    EXPECT_LT(2.0 * cycles[1], cycles[2]);
}

io::HistoryTable history_of(std::vector<double> time, std::vector<double> value) {
    io::HistoryTable table;
    table.columns = {{.name = "time", .unit = "s", .doc = ""},
                     {.name = "value", .unit = "", .doc = ""}};
    table.values = {std::move(time), std::move(value)};
    return table;
}

TEST(FigureSeries, LeavesOutWhatIsNoNumberOrOutsideOfTheTimes) {
    const auto table = history_of({0.0, 1.0, 2.0, 3.0}, {none, 10.0, 20.0, 30.0});
    const TimeSeries series = time_series(table, "value", 0.0, 0.5, 2.0);
    EXPECT_THAT(series.time, ElementsAre(1.0, 2.0));
    EXPECT_THAT(series.value, ElementsAre(10.0, 20.0));
}

TEST(FigureSeries, TakesAnAverageFromTheIntervalAfterItsOwn) {
    // Averages over [0, 1] and [1, 2] are 5 and 7; the first interval shows what it has so far, and
    // that of [2, 3] is not known yet in its last row.
    const auto table = history_of({0.0, 0.4, 0.8, 1.0001, 1.4, 1.8, 2.0001, 2.4, 3.0},
                                  {none, 3, 4, 4.5, 5, 5, 5, 7, 7});
    const TimeSeries series = time_series(table, "value", 1.0, 0.0, 10.0);
    EXPECT_THAT(series.time, ElementsAre(1.0, 2.0));
    EXPECT_THAT(series.value, ElementsAre(5.0, 7.0));
}

TEST(FigureSeries, MeanIsTakenAtTimesThatAllReach) {
    const MeanSeries mean = mean_series({{.time = {0.0, 1.0, 2.0}, .value = {0.0, 2.0, 4.0}},
                                         {.time = {0.5, 1.5}, .value = {3.0, 5.0}}});
    EXPECT_THAT(mean.time, ElementsAre(1.0));
    EXPECT_THAT(mean.mean, ElementsAre(DoubleNear(3.0, round_off)));
    // Values 2 and 4: each is one from the mean, and the square is divided by n - 1 = 1.
    EXPECT_THAT(mean.deviation, ElementsAre(DoubleNear(std::sqrt(2.0), round_off)));
}

TEST(FigureIndex, EscapesWhatWouldEndATag) {
    FigureIndex index;
    index.title = "a < b & \"c\"";
    EXPECT_THAT(to_html(index),
                AllOf(HasSubstr("a &lt; b &amp; &quot;c&quot;"), Not(HasSubstr("a < b"))));
}

}  // namespace
}  // namespace grainbench::cli
