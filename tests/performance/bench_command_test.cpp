#include "cli/bench_command.hpp"

#include "core/error.hpp"

#include "io/json/scene_json.hpp"

#include "cli/bench/cases.hpp"
#include "cli/bench/timing.hpp"
#include "cli/bench/work_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <set>
#include <sstream>

namespace grainbench::cli {
namespace {

using ::testing::HasSubstr;

const BenchMachine machine{.cpu_model = "some \"fast\" processor",
                           .compiler = "some compiler",
                           .flags = "-some -flags",
                           .program = "grainbench 0.0.0 (none)"};

BenchCase case_named(const std::string& name) {
    for (const BenchCase& bench_case : bench_cases()) {
        if (bench_case.name == name) {
            return bench_case;
        }
    }
    throw std::runtime_error("no case " + name);
}

TEST(BenchCommand, WritesTheSameNumbersAsJsonAndToItsFile) {
    const std::string file = ::testing::TempDir() + "bench.json";
    std::ostringstream out;
    std::ostringstream err;
    const BenchArguments arguments{
        .filter = "^effects/linear_spring$", .json = true, .output = file, .threads = 2};
    EXPECT_EQ(bench_command(arguments, machine, out, err), 0);
    EXPECT_THAT(err.str(), HasSubstr("effects/linear_spring"));
    std::stringstream written;
    written << std::ifstream(file).rdbuf();
    EXPECT_EQ(written.str(), out.str());

    const auto report = nlohmann::json::parse(out.str());
    EXPECT_EQ(report.at("cpu_model"), machine.cpu_model);
    EXPECT_EQ(report.at("format"), "grainbench-bench/2");
    EXPECT_EQ(report.at("program"), machine.program);
    EXPECT_EQ(report.at("threads"), 2);
    ASSERT_EQ(report.at("benchmarks").size(), 1U);
    const auto& row = report.at("benchmarks").at(0);
    EXPECT_EQ(row.at("name"), "effects/linear_spring");
    EXPECT_EQ(row.at("particles"), 4000);
    EXPECT_EQ(row.at("step_times").size(), 7U);
    EXPECT_GT(row.at("step_time"), 0.0);
    EXPECT_LE(row.at("step_time"), row.at("step_time_median"));
    // Printed with six digits.
    EXPECT_NEAR(row.at("timestep").get<double>(), 5e-6, 1e-11);
    // Each ball of a packed bed shares contacts with 12 neighbours at most, and with the box.
    EXPECT_GT(row.at("touching"), 2.0);
    EXPECT_LT(row.at("touching"), row.at("objects"));
    EXPECT_LT(row.at("objects"), 7.0);
    // Nothing in this scene bounds the step or is written; all else takes time.
    for (const char* phase : {"integration", "detection", "contacts", "walls"}) {
        EXPECT_GT(row.at("phases").at(phase), 0.0) << phase;
    }
    const auto& roofline = row.at("roofline");
    EXPECT_GT(roofline.at("fraction"), 0.0);
    EXPECT_GT(roofline.at("bandwidth"), 1e8);
    EXPECT_GT(roofline.at("peak"), 1e8);
}

TEST(BenchCommand, ComparesThreadsInOneSceneWithOne) {
    std::ostringstream out;
    std::ostringstream err;
    const BenchArguments arguments{.filter = "^effects/linear_spring$",
                                   .json = true,
                                   .output = {},
                                   .threads = 1,
                                   .scaling = 2};
    EXPECT_EQ(bench_command(arguments, machine, out, err), 0);
    const auto report = nlohmann::json::parse(out.str());
    EXPECT_EQ(report.at("format"), "grainbench-scaling/1");
    EXPECT_EQ(report.at("threads"), 2);
    const auto& row = report.at("benchmarks").at(0);
    EXPECT_EQ(row.at("alone").size(), 7U);
    EXPECT_EQ(row.at("shared").size(), 7U);
    EXPECT_GT(row.at("speed_up"), 0.0);
    EXPECT_TRUE(row.at("same_state"));
}

/// By hand from the table of share/doc/performance.md: nobody touches, nothing is listed.
TEST(WorkModel, CountsTheFlightOfALoneParticle) {
    Contact contact;
    contact.normal = LinearSpring::Params{};
    const Work work = work_of({.particles = 1.0}, contact, false);
    EXPECT_EQ(work.operations, 18.0);
    // Position and velocity read and written, the flag too; the position once more by the search.
    EXPECT_EQ(work.bytes, 4.0 * 32.0 + 2.0 + 32.0);
    EXPECT_EQ(work.working_set, 161.0);
}

/// A scene pays for the laws that it calls for, in the model as in the engine.
TEST(WorkModel, CountsTheLawsOfAContact) {
    Contact spring;
    spring.normal = LinearSpring::Params{};
    Contact rough = spring;
    rough.friction = CoulombFriction::Params{.coefficient = 0.5};
    const WorkCounts touching{.particles = 2.0, .touching = 0.5, .loaded = 1.0, .objects = 0.5};
    const WorkCounts apart{.particles = 2.0, .touching = 0.0, .loaded = 0.0, .objects = 0.5};
    const auto operations = [&](const WorkCounts& counts, const Contact& contact) {
        return work_of(counts, contact, false).operations;
    };
    EXPECT_EQ(operations(apart, spring), operations(apart, rough));
    // Opening speed 8, sliding 41, shear force 6, torque 21, friction 63; half a contact each.
    EXPECT_EQ(operations(touching, rough) - operations(touching, spring), 0.5 * 139.0);
    EXPECT_GT(work_of(touching, rough, false).bytes, work_of(touching, spring, false).bytes);
}

TEST(BenchCommand, NamesTheBenchmarksWhereNoneMatches) {
    std::ostringstream out;
    for (const char* filter : {"no such thing", "(unclosed"}) {
        try {
            BenchArguments arguments;
            arguments.filter = filter;
            bench_command(arguments, machine, out, out);
            ADD_FAILURE() << filter << " was accepted";
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::bad_input);
            EXPECT_THAT(error.what(), HasSubstr(filter));
            EXPECT_THAT(error.what(), HasSubstr("shaken_bed/automatic_step"));
        }
    }
}

TEST(BenchCases, HaveNamesOfTheirOwn) {
    std::set<std::string> names;
    for (const BenchCase& bench_case : bench_cases()) {
        EXPECT_TRUE(names.insert(bench_case.name).second) << bench_case.name;
        EXPECT_GE(bench_case.repetitions, 5) << bench_case.name;
    }
}

/// Exact: the same scene by another way.
TEST(BenchCases, ShakeTheBedOfTheExample) {
    const std::string file = GRAINBENCH_SOURCE_DIR "/presets/scenes/bne.json";
    Simulation example(io::read_scene(file), 0);
    Simulation timed(case_named("shaken_bed/automatic_step").scene(), 0);
    Observer nobody;
    example.advance(200, nobody);
    timed.advance(200, nobody);
    EXPECT_EQ(timed.time(), example.time());
    EXPECT_TRUE(timed.particle_frame().position == example.particle_frame().position);
    EXPECT_TRUE(timed.particle_frame().velocity == example.particle_frame().velocity);
}

/// Counts are sums over cycles of exactly the span that was timed.
TEST(BenchRun, TimesTheSpanItWasAskedFor) {
    BenchCase bench_case = case_named("shaken_bed/fixed_step");
    bench_case.prepared = 0.001;
    bench_case.span = 0.002;
    BenchRun run(bench_case);
    run.prepare();
    const std::uint64_t first = run.simulation().cycle();
    const BenchTiming timing = run.time_one_span();
    const double cycles = static_cast<double>(run.simulation().cycle() - first);
    EXPECT_EQ(timing.cycles, cycles);
    EXPECT_EQ(timing.particle_steps,
              cycles * static_cast<double>(run.simulation().particle_count()));
    EXPECT_GE(timing.simulated, 0.002);
    EXPECT_LT(timing.simulated, 0.0023);  // at most one slice of 20 cycles more
    EXPECT_GT(timing.cpu_seconds, 0.0);
}

}  // namespace
}  // namespace grainbench::cli
