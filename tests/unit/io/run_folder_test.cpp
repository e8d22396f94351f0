#include "io/run_folder.hpp"

#include "io/atomic_file.hpp"
#include "io/hdf5/checkpoint.hpp"
#include "io/hdf5/history.hpp"
#include "io/vtk/frame_reader.hpp"
#include "io/vtk/pvd.hpp"

#include "tests/unit/io/frames.hpp"
#include "tests/unit/io/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <thread>

namespace grainbench::io {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;
using testing::StartsWith;

constexpr const char* scene_json = "{\"title\": \"tiny\"}\n";

Scene tiny_scene() {
    Scene scene;
    scene.title = "tiny";
    scene.particles.species.push_back({.name = "glass", .radius = 0.5, .density = 1.0});
    scene.stages.resize(2);
    scene.stages[1].output = Output{};
    scene.stages[1].output->contacts = true;
    scene.realisations = {.count = 2, .seed = 500};
    return scene;
}

/// Plays a simulation that reports in steps 0, 1, 2 ... up to `end`, with a checkpoint in every
/// third; starts where the folder says.
void play(RunFolder& folder, std::size_t realisation, int end) {
    const std::vector<HistoryColumn> columns{{"time", "s", "time"}, {"cycle", "1", "cycle"}};
    const std::optional<Archive> archive = folder.load_checkpoint().at(realisation);
    for (int step = archive ? static_cast<int>(archive->number("time")) + 1 : 0; step < end;
         ++step) {
        const double time = step;
        folder.append_history(realisation, columns, std::vector<double>{time, 10.0 * time});
        const TraceTable traces = some_traces(1, {time});
        folder.append_trace(realisation, time, traces.points);
        const ContactFrame contacts = some_contacts(2, time);
        // The contact network is asked for in some frames only.
        folder.write_frame(realisation,
                           some_particles(3 + realisation, time),
                           some_walls(time),
                           step % 2 == 0 ? &contacts : nullptr);
        if (step % 3 == 2) {
            Archive state;
            state.put("time", time);
            folder.write_checkpoint(realisation, state);
        }
    }
}

/// Name relative to the folder and content of each file.
std::map<std::string, std::string> content_of(const std::filesystem::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) {
            files[entry.path().lexically_relative(folder).string()] = read_file(entry.path());
        }
    }
    return files;
}

std::vector<double> times_of(const std::filesystem::path& pvd) {
    std::vector<double> times;
    for (const PvdEntry& entry : read_pvd(pvd)) {
        times.push_back(entry.time);
    }
    return times;
}

/// Plays to `stop`, then resumes and plays to the end; everything must be as if it never stopped.
void expect_same_as_uninterrupted(int stop, bool newest_is_damaged) {
    const TemporaryFolder folder;
    const Scene scene = tiny_scene();
    {
        RunFolder straight(folder / "straight", scene_json, scene, 2, {});
        play(straight, 0, 8);
        play(straight, 1, 8);
        straight.finish({});
    }
    {
        RunFolder first(folder / "broken", scene_json, scene, 2, {});
        play(first, 0, stop);
        play(first, 1, stop);
    }
    if (newest_is_damaged) {
        write_file(folder / "broken" / "checkpoint.h5", "garbage");
    }
    write_file(folder / "broken" / "realisation-1" / "walls_000009.vtp.tmp", "torn");
    {
        RunFolder second(folder / "broken", scene_json, scene, 2, {.resume = true});
        EXPECT_EQ(second.warning().empty(), !newest_is_damaged);
        play(second, 0, 8);
        play(second, 1, 8);
        second.finish({});
    }
    const auto straight = content_of(folder / "straight");
    const auto broken = content_of(folder / "broken");
    std::vector<std::string> names;
    for (const auto& [name, bytes] : broken) {
        names.push_back(name);
        // Which checkpoint is the previous one depends on where the run stopped.
        if (name != "checkpoint-previous.h5") {
            EXPECT_TRUE(straight.contains(name) && straight.at(name) == bytes) << name;
        }
    }
    EXPECT_THAT(names, SizeIs(straight.size()));
}

TEST(RunFolder, HoldsWhatParaViewAndReadersExpect) {
    const TemporaryFolder folder;
    const auto run = folder / "run 1.5 \xC3\xBC";
    RunFolder output(run, scene_json, tiny_scene(), 2, {.history_csv = true});
    play(output, 0, 3);
    play(output, 1, 2);
    Manifest manifest;
    manifest.version = "1.2.3";
    output.finish(manifest);

    EXPECT_EQ(read_file(run / "scene.json"), scene_json);
    EXPECT_THAT(times_of(run / "realisation-1" / "particles.pvd"), ElementsAre(0.0, 1.0, 2.0));
    EXPECT_THAT(times_of(run / "realisation-1" / "contacts.pvd"), ElementsAre(0.0, 2.0));
    for (const char* series : {"particles.pvd", "walls.pvd", "contacts.pvd"}) {
        for (const PvdEntry& entry : read_pvd(run / "realisation-1" / series)) {
            EXPECT_TRUE(file_exists(run / "realisation-1" / entry.file)) << entry.file;
        }
    }
    EXPECT_EQ(read_particles_frame(run / "realisation-2" / "particles_000001.vtu").size(), 4U);
    EXPECT_EQ(read_walls_frame(run / "realisation-1" / "walls_000002.vtp").time, 2.0);
    EXPECT_TRUE(file_exists(run / "realisation-2" / "traces.vtp"));
    const History history = read_history(run / "history.h5");
    EXPECT_THAT(history.realisations.at(0).history.column("cycle"), ElementsAre(0, 10, 20));
    EXPECT_EQ(history.realisations.at(1).seed, 501);
    EXPECT_EQ(history.scene, scene_json);
    EXPECT_THAT(read_file(run / "history.csv"), HasSubstr("\n2,1,10\n"));
    EXPECT_EQ(nlohmann::json::parse(read_file(run / "manifest.json")).at("version"), "1.2.3");
}

TEST(RunFolder, RealisationsMayWriteAtTheSameTime) {
    const TemporaryFolder folder;
    const Scene scene = tiny_scene();
    {
        RunFolder output(folder / "one by one", scene_json, scene, 2, {});
        play(output, 0, 8);
        play(output, 1, 8);
        output.finish({});
    }
    RunFolder output(folder / "together", scene_json, scene, 2, {});
    std::thread other([&] { play(output, 1, 8); });
    play(output, 0, 8);
    other.join();
    output.finish({});
    auto expected = content_of(folder / "one by one");
    auto found = content_of(folder / "together");
    expected.erase("checkpoint-previous.h5");
    found.erase("checkpoint-previous.h5");
    EXPECT_EQ(found, expected);
}

TEST(RunFolder, RefusesAFolderThatHoldsARun) {
    const TemporaryFolder folder;
    write_file(folder / "notes.txt", "other files are no run");
    { const RunFolder output(folder.path(), scene_json, tiny_scene(), 1, {}); }
    EXPECT_THAT(error_of([&] { RunFolder(folder.path(), scene_json, tiny_scene(), 1, {}); }),
                AllOf(StartsWith("bad input: "), HasSubstr("--resume"), HasSubstr("-o")));
}

TEST(RunFolder, ResumedRunWritesTheSameFilesAsOneThatNeverStopped) {
    expect_same_as_uninterrupted(5, false);  // frames 3 and 4 come after the checkpoint
    expect_same_as_uninterrupted(3, false);  // stopped right at the checkpoint
    expect_same_as_uninterrupted(2, false);  // stopped before the first checkpoint
}

TEST(RunFolder, DamagedCheckpointResumesFromThePrevious) {
    expect_same_as_uninterrupted(7, true);
}

TEST(RunFolder, ResumingTakesBackFramesAfterTheCheckpoint) {
    const TemporaryFolder folder;
    {
        RunFolder output(folder.path(), scene_json, tiny_scene(), 1, {});
        play(output, 0, 5);
    }
    const RunFolder output(folder.path(), scene_json, tiny_scene(), 1, {.resume = true});
    const auto realisation = folder / "realisation-1";
    EXPECT_EQ(output.load_checkpoint().at(0)->number("time"), 2.0);
    EXPECT_THAT(times_of(realisation / "particles.pvd"), ElementsAre(0.0, 1.0, 2.0));
    EXPECT_THAT(times_of(realisation / "contacts.pvd"), ElementsAre(0.0, 2.0));
    EXPECT_TRUE(file_exists(realisation / "particles_000002.vtu"));
    EXPECT_FALSE(file_exists(realisation / "particles_000003.vtu"));
    EXPECT_FALSE(file_exists(realisation / "walls_000004.vtp"));
    EXPECT_EQ(read_history(folder / "history.h5").realisations.at(0).history.rows(), 3U);
    EXPECT_THAT(read_history(folder / "history.h5").realisations.at(0).traces.time, SizeIs(3));
}

TEST(RunFolder, RefusesToResumeAnotherScene) {
    const TemporaryFolder folder;
    const auto resume = [&](const std::string& json, const Scene& scene) {
        return error_of([&] { RunFolder(folder.path(), json, scene, 1, {.resume = true}); });
    };
    { const RunFolder output(folder.path(), scene_json, tiny_scene(), 1, {}); }
    EXPECT_THAT(resume("{}", tiny_scene()), AllOf(StartsWith("bad input: "), HasSubstr("-o")));
    {
        RunFolder output(folder.path(), scene_json, tiny_scene(), 1, {.resume = true});
        play(output, 0, 3);
    }
    EXPECT_THAT(resume("{}", tiny_scene()), StartsWith("bad input: "));
    Scene other_mesh = tiny_scene();
    other_mesh.walls.push_back({.name = "w", .shape = MeshFile{}, .motion = {}, .material = {}});
    std::get<MeshFile>(other_mesh.walls[0].shape).vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    std::get<MeshFile>(other_mesh.walls[0].shape).triangles = {{0, 1, 2}};
    EXPECT_THAT(resume(scene_json, other_mesh), StartsWith("bad input: "));
    EXPECT_EQ(read_file(folder / "scene.json"), scene_json);
    EXPECT_TRUE(file_exists(folder / "realisation-1" / "particles_000002.vtu"));
}

TEST(RunFolder, HistoryOlderThanTheCheckpointIsRefused) {
    const TemporaryFolder folder;
    std::string early;
    {
        RunFolder output(folder.path(), scene_json, tiny_scene(), 1, {});
        early = read_file(folder / "history.h5");
        play(output, 0, 3);
    }
    write_file(folder / "history.h5", early);
    EXPECT_THAT(
        error_of([&] { RunFolder(folder.path(), scene_json, tiny_scene(), 1, {.resume = true}); }),
        AllOf(StartsWith("input/output: "), HasSubstr("history.h5")));
}

TEST(RunFolder, EmptyFolderMayBeResumed) {
    const TemporaryFolder folder;
    const RunFolder output(folder / "new", scene_json, tiny_scene(), 2, {.resume = true});
    ASSERT_THAT(output.load_checkpoint(), SizeIs(2));
    EXPECT_FALSE(output.load_checkpoint()[0] || output.load_checkpoint()[1]);
}

TEST(RunFolder, ContactsAreAskedForByTheStage) {
    const TemporaryFolder folder;
    const RunFolder output(folder.path(), scene_json, tiny_scene(), 1, {});
    EXPECT_FALSE(output.wants_contacts(0));
    EXPECT_TRUE(output.wants_contacts(1));
}

TEST(Manifest, HoldsEveryNumberAndSurvivesOddOnes) {
    Manifest manifest;
    manifest.cpu = "odd \xFF name";
    manifest.effects = {"gravity"};
    RealisationManifest realisation;
    realisation.insertion.push_back({.asked = 3, .placed = 2, .tries = 9});
    realisation.summary.mean_timestep = std::numeric_limits<double>::quiet_NaN();
    realisation.summary.average_elevation = 0.25;
    realisation.state_hash = 0xABCULL;
    manifest.realisations.push_back(realisation);
    const auto json = nlohmann::json::parse(to_json(manifest));
    EXPECT_EQ(json.at("effects").at(0), "gravity");
    const auto& first = json.at("realisations").at(0);
    EXPECT_EQ(first.at("insertion").at(0).at("placed"), 2);
    EXPECT_TRUE(first.at("summary").at("mean_timestep").is_null());
    EXPECT_EQ(first.at("summary").at("average_elevation"), 0.25);
    EXPECT_FALSE(first.at("summary").contains("entrainment_time"));
    EXPECT_EQ(first.at("state_hash"), "0000000000000abc");
}

}  // namespace
}  // namespace grainbench::io
