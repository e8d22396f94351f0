// Pictures by command: render and compare.
#include "io/atomic_file.hpp"

#include "render/image.hpp"

#include "tests/cli/invoke.hpp"
#include "tests/cli/scenes.hpp"
#include "tests/unit/io/temporary_folder.hpp"
#include "tests/unit/render/small_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace grainbench::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class RenderCommand : public testing::Test {
protected:
    RenderCommand() { write_small_run(run_); }

    Answer render(std::vector<std::string> more) const {
        std::vector<std::string> all{"render", run_.string(), "--size", "120x90"};
        all.insert(all.end(), more.begin(), more.end());
        return invoke(all);
    }

    TemporaryFolder folder_;
    std::filesystem::path run_ = folder_ / "run";
};

TEST_F(RenderCommand, DrawsEveryFrameOfARunFolder) {
    const Answer answer = render({});
    EXPECT_EQ(answer.code, 0) << answer.err;
    for (const char* name :
         {"particles_000000.png", "particles_000001.png", "particles_000002.png"}) {
        const auto file = run_ / "pictures" / name;
        EXPECT_THAT(answer.out, HasSubstr(file.string()));
        EXPECT_EQ(render::read_png(file).size, (render::ImageSize{120, 90}));
    }
}

TEST_F(RenderCommand, DrawsTheTimesOfALookThatNamesItsRun) {
    io::write_file(folder_ / "spec.json",
                   R"({"format": "grainbench-render/1", "run": "run", "times": [0.1],
                       "width": 100, "height": 80, "particles": {}})");
    const Answer answer =
        invoke({"render", (folder_ / "spec.json").string(), "-o", (folder_ / "pictures").string()});
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_EQ(answer.out, (folder_ / "pictures" / "spec_000001.png").string() + "\n");
}

TEST_F(RenderCommand, SaysWhatIsWrong) {
    const Answer array =
        render({"--set", "/particles/colour/type=array", "--set", "/particles/colour/array=speed"});
    EXPECT_EQ(array.code, 2);
    EXPECT_THAT(array.err, AllOf(HasSubstr("no array 'speed'"), HasSubstr("'velocity'")));

    const Answer size = invoke({"render", run_.string(), "--size", "120"});
    EXPECT_EQ(size.code, 2);
    EXPECT_THAT(size.err, HasSubstr("1600x1000"));

    const Answer time = render({"--time", "9"});
    EXPECT_EQ(time.code, 2);
    EXPECT_THAT(time.err, HasSubstr("from 0 s to 0.2 s"));

    const Answer folder = invoke({"render", (folder_ / "absent").string()});
    EXPECT_EQ(folder.code, 2);
    EXPECT_THAT(folder.err, HasSubstr("no run folder"));

    io::write_file(run_ / "realisation-1" / "particles_000000.vtu", "torn");
    const Answer torn = render({"--time", "first"});
    EXPECT_EQ(torn.code, 5);
    EXPECT_THAT(torn.err, HasSubstr("particles_000000.vtu"));
}

TEST_F(RenderCommand, DrawsARunWithoutParticles) {
    io::write_file(folder_ / "cup.json", cup_scene);
    const auto run = folder_ / "empty";
    const Answer ran = invoke({"run",
                               (folder_ / "cup.json").string(),
                               "-o",
                               run.string(),
                               "--set",
                               "/particles/insertion=[]",
                               "--set",
                               "/traces=[]"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Answer drawn = invoke({"render", run.string(), "--size", "120x90"});
    EXPECT_EQ(drawn.code, 0) << drawn.err;
    EXPECT_THAT(drawn.out, HasSubstr("particles_000004.png"));  // 0.2 s, a frame every 0.05 s
}

TEST_F(RenderCommand, PicturesOfARunEqualThoseDrawnLater) {
    io::write_file(folder_ / "cup.json", cup_scene);
    io::write_file(folder_ / "small.json",
                   R"({"format": "grainbench-render/1", "width": 120, "height": 90,
                       "particles": {"colour": {"type": "speed"}}, "walls": {}, "legend": {}})");
    const auto look = (folder_ / "small.json").string();
    const auto run = folder_ / "cup";
    const Answer ran = invoke({"run",
                               (folder_ / "cup.json").string(),
                               "-o",
                               run.string(),
                               "--set",
                               "/stages/0/duration=1e-4",
                               "--set",
                               "/stages/1/duration=1e-4",
                               "--look",
                               look});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto later = folder_ / "later";
    ASSERT_EQ(invoke({"render", run.string(), "--look", look, "-o", later.string()}).code, 0);
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(later)) {
        EXPECT_EQ(io::read_file(entry.path()),
                  io::read_file(run / "pictures" / entry.path().filename()));
        ++count;
    }
    EXPECT_GE(count, 2U);
}

TEST_F(RenderCommand, CompareTellsPicturesApart) {
    ASSERT_EQ(render({}).code, 0);
    const std::string first = (run_ / "pictures" / "particles_000000.png").string();
    const std::string last = (run_ / "pictures" / "particles_000002.png").string();
    const std::string difference = (folder_ / "difference.png").string();

    EXPECT_EQ(invoke({"compare", first, first}).code, 0);
    const Answer unlike = invoke({"compare", first, last, "-o", difference});
    EXPECT_EQ(unlike.code, 4);
    EXPECT_THAT(unlike.out, HasSubstr("over the threshold of 0.02"));
    EXPECT_EQ(render::read_png(difference).size, (render::ImageSize{120, 90}));

    const Answer json = invoke({"compare", first, last, "--threshold", "2", "--json"});
    EXPECT_EQ(json.code, 0);
    EXPECT_EQ(nlohmann::json::parse(json.out).at("alike"), true);

    const Answer text = invoke({"compare", first, (run_ / "scene.json").string()});
    EXPECT_EQ(text.code, 2);
}

}  // namespace
}  // namespace grainbench::cli
