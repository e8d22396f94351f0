// The program as a process: signals, kills, and going on from what they leave.
#include "tests/cli/process.hpp"

#include "io/atomic_file.hpp"
#include "io/hdf5/checkpoint.hpp"
#include "io/hdf5/history.hpp"
#include "io/vtk/frame_reader.hpp"
#include "io/vtk/pvd.hpp"

#include "tests/cli/scenes.hpp"
#include "tests/unit/io/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <thread>

namespace grainbench::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class ProcessTest : public testing::Test {
protected:
    ProcessTest() { io::write_file(folder_ / "cup.json", cup_scene); }

    /// Long enough to be stopped on the way: some 35000 cycles, 12 frames, a checkpoint twice as
    /// often. A signal is seen within some 2000 cycles.
    std::vector<std::string> arguments(const std::string& to, bool resume) const {
        std::vector<std::string> all{
            "run", (folder_ / "cup.json").string(), "-o", (folder_ / to).string()};
        for (const char* set : {"/stages/0/duration=0.6",
                                "/stages/1/duration=0.6",
                                "/output/frame_interval=0.1",
                                "/output/checkpoint_interval=0.05"}) {
            all.insert(all.end(), {"--set", set});
        }
        if (resume) {
            all.push_back("--resume");
        }
        return all;
    }

    std::filesystem::path err() const { return folder_ / "err.txt"; }

    int finish(const std::string& to, bool resume) const {
        return Process(arguments(to, resume), err()).wait();
    }

    /// Starts a run, waits for a frame of the first realisation, sends a signal; the exit code.
    int stop_at_frame(const std::string& to,
                      bool resume,
                      const std::string& frame,
                      int signal) const {
        Process process(arguments(to, resume), err());
        const auto file = folder_ / to / "realisation-1" / ("particles_" + frame + ".vtu");
        const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
        while (!io::file_exists(file) && process.is_running() &&
               std::chrono::steady_clock::now() < deadline) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        EXPECT_TRUE(io::file_exists(file)) << io::read_file(err());
        process.send(signal);
        return process.wait();
    }

    nlohmann::json manifest(const std::string& of) const {
        return nlohmann::json::parse(io::read_file(folder_ / of / "manifest.json"));
    }

    std::vector<std::string> hashes(const std::string& of) const {
        std::vector<std::string> found;
        const nlohmann::json data = manifest(of);
        for (const nlohmann::json& realisation : data.at("realisations")) {
            found.push_back(realisation.at("state_hash"));
        }
        EXPECT_EQ(found.size(), 2U);
        return found;
    }

    /// Reads every file that has its final name.
    void expect_whole_files(const std::string& of) const {
        const auto run = folder_ / of;
        const std::string hash = io::read_history(run / "history.h5").scene_hash;
        std::string warning;
        EXPECT_TRUE(io::read_checkpoint(run / "checkpoint.h5", hash, warning).has_value());
        EXPECT_EQ(warning, "");
        for (const char* realisation : {"realisation-1", "realisation-2"}) {
            for (const auto& entry : std::filesystem::directory_iterator(run / realisation)) {
                const std::string name = entry.path().filename().string();
                if (name.ends_with(".vtu")) {
                    EXPECT_EQ(io::read_particles_frame(entry.path()).size(), 144U) << name;
                } else if (name.starts_with("walls_") && name.ends_with(".vtp")) {
                    EXPECT_EQ(io::read_walls_frame(entry.path()).walls.size(), 1U) << name;
                } else if (name.ends_with(".pvd")) {
                    EXPECT_FALSE(io::read_pvd(entry.path()).empty()) << name;
                }
            }
        }
    }

    TemporaryFolder folder_;
};

TEST_F(ProcessTest, InterruptedRunGoesOnToTheSameBits) {
    ASSERT_EQ(finish("straight", false), 0) << io::read_file(err());
    EXPECT_EQ(stop_at_frame("broken", false, "000001", SIGINT), 130);
    EXPECT_THAT(io::read_file(err()), HasSubstr("--resume"));
    EXPECT_EQ(manifest("broken").at("outcome"), "interrupted");
    expect_whole_files("broken");
    EXPECT_EQ(stop_at_frame("broken", true, "000008", SIGTERM), 130);  // in the second stage
    ASSERT_EQ(finish("broken", true), 0) << io::read_file(err());
    EXPECT_EQ(manifest("broken").at("outcome"), "finished");
    EXPECT_EQ(hashes("broken"), hashes("straight"));
    for (const char* file :
         {"history.h5", "realisation-2/particles.pvd", "realisation-1/traces.vtp"}) {
        EXPECT_EQ(io::read_file(folder_ / "broken" / file),
                  io::read_file(folder_ / "straight" / file))
            << file;
    }
}

TEST_F(ProcessTest, KilledRunLeavesWholeFilesAndGoesOnToTheSameBits) {
    ASSERT_EQ(finish("straight", false), 0) << io::read_file(err());
    bool resume = false;
    for (const char* frame : {"000001", "000004", "000009"}) {
        EXPECT_EQ(stop_at_frame("broken", resume, frame, SIGKILL), -SIGKILL);
        expect_whole_files("broken");
        resume = true;
    }
    ASSERT_EQ(finish("broken", true), 0) << io::read_file(err());
    EXPECT_EQ(hashes("broken"), hashes("straight"));
}

TEST_F(ProcessTest, DamagedCheckpointGoesOnFromThePreviousToTheSameBits) {
    ASSERT_EQ(finish("straight", false), 0) << io::read_file(err());
    ASSERT_EQ(stop_at_frame("broken", false, "000004", SIGKILL), -SIGKILL);
    io::write_file(folder_ / "broken" / "checkpoint.h5", "torn");
    ASSERT_EQ(finish("broken", true), 0) << io::read_file(err());
    EXPECT_THAT(io::read_file(err()), HasSubstr("warning: "));
    EXPECT_EQ(hashes("broken"), hashes("straight"));
}

TEST_F(ProcessTest, WithoutOsMesaOnlyDrawingFails) {
    // The dynamic linker takes this file for the library and cannot load it.
    io::write_file(folder_ / "libOSMesa.so.8", "");
    ASSERT_EQ(setenv("LD_LIBRARY_PATH", folder_.path().c_str(), 1), 0);
    EXPECT_EQ(Process({"check", (folder_ / "cup.json").string()}, err()).wait(), 0);
    EXPECT_EQ(Process({"doctor"}, err()).wait(), 5);
    unsetenv("LD_LIBRARY_PATH");
    EXPECT_THAT(io::read_file(err()),
                AllOf(HasSubstr("\nVTK "), HasSubstr("apt-get install libosmesa6")));
}

}  // namespace
}  // namespace grainbench::cli
