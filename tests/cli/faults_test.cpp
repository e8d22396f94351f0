// Disks that are full or read-only, and files that others have changed: a clear message, an exit
// code, and nothing half-written under a final name.
#include "io/atomic_file.hpp"
#include "io/hdf5/checkpoint.hpp"
#include "io/hdf5/history.hpp"

#include "tests/cli/process.hpp"
#include "tests/cli/scenes.hpp"
#include "tests/unit/io/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>

#include <algorithm>

namespace grainbench::cli {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;

/// A file system in memory, seen by this process and its children alone.
class SmallDisk {
public:
    SmallDisk(const std::filesystem::path& at, const std::string& size) : at_(at) {
        std::filesystem::create_directories(at);
        is_there_ = unshare(CLONE_NEWNS) == 0 &&
                    mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
                    mount("none", at.c_str(), "tmpfs", 0, ("size=" + size).c_str()) == 0;
    }

    ~SmallDisk() {
        if (is_there_) {
            umount2(at_.c_str(), MNT_DETACH);
        }
    }

    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;

    bool is_there() const { return is_there_; }

    void remount(unsigned long flags, const std::string& size) const {
        ASSERT_EQ(mount("none", at_.c_str(), "tmpfs", MS_REMOUNT | flags, ("size=" + size).c_str()),
                  0);
    }

private:
    std::filesystem::path at_;
    bool is_there_ = false;
};

class FaultTest : public testing::Test {
protected:
    FaultTest() { io::write_file(folder_ / "cup.json", cup_scene); }

    int run(const std::filesystem::path& to,
            bool resume = false,
            const std::function<void()>& prepare = {}) const {
        std::vector<std::string> all{"run", (folder_ / "cup.json").string(), "-o", to.string()};
        for (const char* set : {"/stages/0/duration=0.1",
                                "/stages/1/duration=0.05",
                                "/output/frame_interval=0.01",
                                "/output/checkpoint_interval=0.01"}) {
            all.insert(all.end(), {"--set", set});
        }
        if (resume) {
            all.push_back("--resume");
        }
        return Process(all, err(), prepare).wait();
    }

    std::filesystem::path err() const { return folder_ / "err.txt"; }

    std::string said() const { return io::read_file(err()); }

    static void expect_no_half_file(const std::filesystem::path& run) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(run)) {
            EXPECT_NE(entry.path().extension(), ".tmp") << entry.path();
        }
        if (!io::file_exists(run / "history.h5")) {
            return;  // the fault came before the first output
        }
        const std::string hash = io::read_history(run / "history.h5").scene_hash;
        std::string warning;
        EXPECT_EQ(io::read_checkpoint(run / "checkpoint.h5", hash, warning).has_value(),
                  io::file_exists(run / "checkpoint.h5"));
        EXPECT_EQ(warning, "");
    }

    /// The run in `to`, given room again, ends as one that never met a fault.
    void expect_same_end(const std::filesystem::path& to) const {
        ASSERT_EQ(run(folder_ / "straight"), 0) << said();
        ASSERT_EQ(run(to, true), 0) << said();
        EXPECT_EQ(io::read_file(to / "history.h5"),
                  io::read_file(folder_ / "straight" / "history.h5"));
    }

    TemporaryFolder folder_;
};

TEST_F(FaultTest, FullDiskEndsARunWithFiveAndItGoesOnWhenThereIsRoom) {
    const SmallDisk disk(folder_ / "disk", "1m");
    if (!disk.is_there()) {
        GTEST_SKIP() << "no right to mount a file system";
    }
    const auto to = folder_ / "disk" / "run";
    EXPECT_EQ(run(to), 5);
    EXPECT_THAT(said(),
                AllOf(HasSubstr("No space left on device"), HasSubstr("the disk or the quota")));
    expect_no_half_file(to);
    disk.remount(0, "64m");
    expect_same_end(to);
}

TEST_F(FaultTest, ReadOnlyDiskEndsARunWithFive) {
    const SmallDisk disk(folder_ / "disk", "1m");
    if (!disk.is_there()) {
        GTEST_SKIP() << "no right to mount a file system";
    }
    disk.remount(MS_RDONLY, "1m");
    EXPECT_EQ(run(folder_ / "disk" / "run"), 5);
    EXPECT_THAT(said(), AllOf(HasSubstr("Read-only file system"), HasSubstr("-o")));
}

/// Beyond the limit the system writes a part of what it is given, then nothing.
TEST_F(FaultTest, ShortWritesEndARunWithFiveAndItGoesOnWithoutTheLimit) {
    const auto to = folder_ / "run";
    ASSERT_EQ(run(folder_ / "measure"), 0) << said();
    const auto largest =
        std::max(std::filesystem::file_size(folder_ / "measure" / "history.h5"),
                 std::filesystem::file_size(folder_ / "measure" / "checkpoint.h5"));
    std::filesystem::remove_all(folder_ / "measure");
    const auto limit_files = [&] {
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{largest - 1, largest - 1};
        setrlimit(RLIMIT_FSIZE, &limit);
    };
    EXPECT_EQ(run(to, false, limit_files), 5);
    EXPECT_THAT(said(), AllOf(HasSubstr("File too large"), HasSubstr("ulimit -f")));
    expect_no_half_file(to);
    expect_same_end(to);
}

TEST_F(FaultTest, FullStandardOutputExitsWithFive) {
    EXPECT_EQ(Process({"schema", "scene"}, "/dev/full").wait(), 5);
}

TEST_F(FaultTest, CheckpointsOfAnotherVersionExitWithFive) {
    const auto to = folder_ / "run";
    ASSERT_EQ(run(to), 0) << said();
    for (const char* name : {"checkpoint.h5", "checkpoint-previous.h5"}) {
        std::string bytes = io::read_file(to / name);
        bytes.replace(bytes.find("checkpoint/1"), 12, "checkpoint/9");
        io::write_file(to / name, bytes);
    }
    EXPECT_EQ(run(to, true), 5);
    EXPECT_THAT(said(),
                AllOf(HasSubstr("no file of the format grainbench-checkpoint/1"),
                      HasSubstr("next step: ")));
}

}  // namespace
}  // namespace grainbench::cli
