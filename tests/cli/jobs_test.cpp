#include "io/atomic_file.hpp"
#include "io/hdf5/history.hpp"
#include "io/json/scene_json.hpp"

#include "cli/jobs/job_pool.hpp"
#include "cli/jobs/planned_steps.hpp"

#include "tests/cli/invoke.hpp"
#include "tests/cli/scenes.hpp"
#include "tests/unit/io/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <streambuf>

namespace grainbench::cli {
namespace {

using testing::HasSubstr;

/// A terminal on which the first progress line asks for a stop.
class StoppingTerminal : public std::streambuf {
public:
    explicit StoppingTerminal(std::atomic<bool>& stop) : stop_(stop) {}

private:
    int_type overflow(int_type c) override {
        stop_ = stop_ || c == '%';
        return c;
    }

    std::atomic<bool>& stop_;
};

class JobPool : public testing::Test {
protected:
    JobPool() { io::write_file(folder_ / "cup.json", cup_scene); }

    Scene cup(const std::vector<std::string>& overrides = {}) const {
        return io::read_scene(folder_ / "cup.json", overrides);
    }

    std::vector<JobResult> run(const std::vector<Job>& jobs, unsigned threads = 2) {
        return run_jobs(jobs,
                        {.cache = folder_ / "cache", .threads = threads},
                        stop_,
                        {.out = err_, .err = err_});
    }

    TemporaryFolder folder_;
    std::atomic<bool> stop_ = false;
    std::ostringstream err_;
};

TEST_F(JobPool, RunsEachSceneIntoAFolderOfItsOwn) {
    const auto results =
        run({{.name = "rough", .scene = cup()},
             {.name = "smooth", .scene = cup({"/contact/friction/coefficient=0.1"})}});
    ASSERT_EQ(results.size(), 2U);
    EXPECT_TRUE(all_ended(results));
    EXPECT_NE(results[0].folder, results[1].folder);
    for (const JobResult& result : results) {
        EXPECT_FALSE(result.reused);
        EXPECT_EQ(result.manifest.outcome, "finished");
        EXPECT_EQ(io::read_history(result.folder / "history.h5").realisations.size(), 2U);
        EXPECT_EQ(io::to_json(io::read_manifest(result.folder / "manifest.json")),
                  io::to_json(result.manifest));
    }
    EXPECT_NE(results[0].manifest.realisations[0].state_hash,
              results[1].manifest.realisations[0].state_hash);
}

TEST_F(JobPool, GivesTheSameBitsAsTheCommandRun) {
    const auto results = run({{.name = "cup", .scene = cup()}});
    ASSERT_EQ(
        invoke({"run", (folder_ / "cup.json").string(), "-o", (folder_ / "run").string()}).code, 0);
    const io::Manifest manifest = io::read_manifest(folder_ / "run" / "manifest.json");
    for (std::size_t n = 0; n < 2; ++n) {
        EXPECT_EQ(results[0].manifest.realisations[n].state_hash,
                  manifest.realisations[n].state_hash);
    }
}

TEST_F(JobPool, KeepsWhatEachRealisationCost) {
    const auto results = run({{.name = "cup", .scene = cup()}});
    for (const io::RealisationManifest& realisation : results[0].manifest.realisations) {
        EXPECT_GT(realisation.cycles, 100U);
        EXPECT_EQ(realisation.timed_cycles, realisation.cycles);
        EXPECT_GT(realisation.cpu_seconds, 0.0);
        EXPECT_DOUBLE_EQ(realisation.step_time() * 144.0 * static_cast<double>(realisation.cycles),
                         realisation.cpu_seconds);
    }
}

TEST_F(JobPool, FinishedRunsAreUsedAgainAndChangedOnesRunAnew) {
    const std::string before = io::to_json(run({{.name = "cup", .scene = cup()}})[0].manifest);
    const auto again = run({{.name = "same", .scene = cup()},
                            {.name = "other", .scene = cup({"/realisations/seed=8"})}});
    EXPECT_TRUE(again[0].reused);
    EXPECT_EQ(io::to_json(again[0].manifest), before);
    EXPECT_FALSE(again[1].reused);
    EXPECT_THAT(err_.str(), HasSubstr("2 runs: 1 to do, 1 in the cache"));
}

TEST_F(JobPool, JobsWithEqualScenesShareOneRun) {
    const auto results = run({{.name = "one", .scene = cup()}, {.name = "two", .scene = cup()}});
    EXPECT_EQ(results[0].folder, results[1].folder);
    EXPECT_THAT(err_.str(), HasSubstr("1 runs: 1 to do"));
}

TEST_F(JobPool, TimedRunsAreApartFromTheOthers) {
    const auto results =
        run({{.name = "cup", .scene = cup()}, {.name = "cup", .scene = cup(), .timed = true}});
    EXPECT_NE(results[0].folder, results[1].folder);
    EXPECT_EQ(results[0].manifest.threads, 2);
    EXPECT_EQ(results[1].manifest.threads, 1);
    EXPECT_EQ(results[0].manifest.realisations[0].state_hash,
              results[1].manifest.realisations[0].state_hash);
}

TEST_F(JobPool, StoppedRunsGoOnToTheSameBitsAndTheirCostsAddUp) {
    const Scene scene = cup({"/stages/0/duration=0.4",
                             "/stages/1/duration=0.4",
                             "/realisations/count=5",
                             "/output/frame_interval=null"});
    StoppingTerminal buffer(stop_);
    std::ostream terminal(&buffer);
    const JobOptions options{.cache = folder_ / "cache", .threads = 2};
    const auto stopped = run_jobs(std::vector<Job>{{.name = "cup", .scene = scene}},
                                  options,
                                  stop_,
                                  {.out = err_, .err = terminal, .err_is_terminal = true});
    ASSERT_FALSE(all_ended(stopped));
    EXPECT_EQ(stopped[0].manifest.outcome, "interrupted");

    stop_ = false;
    const auto resumed = run({{.name = "cup", .scene = scene}});
    EXPECT_FALSE(resumed[0].reused);
    const auto whole = run_jobs(std::vector<Job>{{.name = "cup", .scene = scene}},
                                {.cache = folder_ / "another", .threads = 1, .quiet = true},
                                stop_,
                                {.out = err_, .err = err_});
    for (std::size_t n = 0; n < 5; ++n) {
        const io::RealisationManifest& realisation = resumed[0].manifest.realisations[n];
        EXPECT_EQ(realisation.state_hash, whole[0].manifest.realisations[n].state_hash) << n;
        EXPECT_EQ(realisation.timed_cycles, realisation.cycles) << n;
    }
}

TEST_F(JobPool, UnstableRunIsAResultThatIsKept) {
    // Two balls placed into each other, with a force between them that no number can hold.
    const Job job{.name = "stiff",
                  .scene = cup({"/particles/insertion=[{\"type\":\"list\",\"particles\":["
                                "{\"species\":\"bead\",\"position\":[0,0,0.05]},"
                                "{\"species\":\"bead\",\"position\":[0,0,0.051]}]}]",
                                "/contact/stiffness/normal=1e307",
                                "/contact/normal/law=\"linear_spring\"",
                                "/timestep={\"type\":\"fixed\",\"value\":1e-5}"})};
    const auto results = run({job});
    EXPECT_TRUE(all_ended(results));
    EXPECT_EQ(results[0].manifest.outcome, "unstable");
    EXPECT_THAT(results[0].manifest.message, HasSubstr("is unstable"));
    EXPECT_TRUE(run({job})[0].reused);
}

TEST_F(JobPool, ErrorOfASceneNamesItsJobAndLeavesNoFolder) {
    Scene scene = cup();
    scene.groups = {{.name = "none", .species = {}, .box = Box{{5, 5, 5}, {6, 6, 6}}}};
    scene.observables.elevation = ElevationObservable{.upper = "none", .lower = "none"};
    try {
        run({{.name = "variant 3", .scene = scene}});
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("where: variant 3: /observables/elevation"));
    }
    EXPECT_FALSE(io::file_exists(folder_ / "cache"));
}

TEST_F(JobPool, PlansRunsOfHertzsSpheres) {
    // Their step hangs on the speed of impacts, which the plan has to foresee without particles.
    const double soft = planned_cycles(
        cup({"/contact={\"stiffness\":{\"law\":\"hertz_stiffness\",\"young_modulus\":"
             "1e7,\"poisson_ratio\":0.3},\"normal\":{\"law\":\"hertz_spring\"}}"}));
    const double stiff = planned_cycles(
        cup({"/contact={\"stiffness\":{\"law\":\"hertz_stiffness\",\"young_modulus\":"
             "1e9,\"poisson_ratio\":0.3},\"normal\":{\"law\":\"hertz_spring\"}}"}));
    // t_c ~ E^(-2/5) at a given speed.
    EXPECT_NEAR(stiff / soft, std::pow(100.0, 0.4), 0.01 * std::pow(100.0, 0.4));
}

}  // namespace
}  // namespace grainbench::cli
