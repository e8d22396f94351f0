#include "io/hdf5/checkpoint.hpp"

#include "io/atomic_file.hpp"

#include "tests/unit/io/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstring>

namespace grainbench::io {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

Archive archive_at(double time) {
    Archive archive;
    archive.put("time", time);
    archive.put("cycle", std::uint64_t{12});
    return archive;
}

Checkpoint checkpoint_at(double time) {
    return {.scene_hash = "abc", .realisations = {archive_at(time)}};
}

std::optional<Checkpoint> read(const std::filesystem::path& path) {
    std::string warning;
    return read_checkpoint(path, "abc", warning);
}

/// Two checkpoints on the disk; the newest is then changed by `damage`.
template <class Damage>
void expect_fall_back(Damage damage) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder / "checkpoint.h5";
    write_checkpoint(path, checkpoint_at(1.0));
    write_checkpoint(path, checkpoint_at(2.0));
    std::string bytes = read_file(path);
    damage(bytes);
    write_file(path, bytes);

    std::string warning;
    const std::optional<Checkpoint> found = read_checkpoint(path, "abc", warning);
    ASSERT_TRUE(found && found->realisations.at(0));
    EXPECT_EQ(found->realisations.at(0)->number("time"), 1.0);
    EXPECT_THAT(warning, AllOf(HasSubstr(path.string()), HasSubstr("checkpoint-previous.h5")));
}

TEST(CheckpointFile, GivesBackEveryBit) {
    const TemporaryFolder folder;
    Archive archive;
    // Quiet and signalling NaN with payload, denormals, both zeros, infinities.
    std::vector<double> doubles;
    for (const std::uint64_t bits : {0x7FF8'0000'DEAD'BEEFULL,
                                     0xFFF0'0000'0000'0001ULL,
                                     1ULL,
                                     0x800F'FFFF'FFFF'FFFFULL,
                                     0ULL,
                                     0x8000'0000'0000'0000ULL,
                                     0x7FF0'0000'0000'0000ULL}) {
        doubles.push_back(std::bit_cast<double>(bits));
    }
    archive.put("odd doubles", doubles);
    archive.put("particles/velocity/x", std::vector<double>{0.1});
    archive.put("particles", std::vector<std::uint32_t>{0, 1, 0xFFFF'FFFFU});
    archive.put("100 % \xC3\xBC.", std::vector<std::uint64_t>{~0ULL, 1ULL << 53U | 1ULL});
    archive.put("flags", std::vector<std::uint8_t>{0, 255});
    archive.put("nothing", std::vector<std::uint32_t>{});
    write_checkpoint(folder / "checkpoint.h5",
                     {.scene_hash = "abc", .realisations = {archive, std::nullopt, Archive{}}});

    const std::optional<Checkpoint> found = read(folder / "checkpoint.h5");
    ASSERT_TRUE(found);
    ASSERT_EQ(found->realisations.size(), 3U);
    EXPECT_FALSE(found->realisations[1]);
    EXPECT_TRUE(found->realisations[2] && found->realisations[2]->columns().empty());
    const Archive& back = found->realisations[0].value();
    ASSERT_EQ(back.columns().size(), archive.columns().size());
    for (const auto& [name, column] : archive.columns()) {
        if (name != "odd doubles") {
            EXPECT_EQ(back.columns().at(name), column) << name;
        }
    }
    const std::vector<double>& found_doubles = back.get<double>("odd doubles");
    ASSERT_EQ(found_doubles.size(), doubles.size());
    EXPECT_EQ(std::memcmp(found_doubles.data(), doubles.data(), doubles.size() * sizeof(double)),
              0);
}

TEST(CheckpointFile, SameStateGivesSameBytes) {
    const TemporaryFolder folder;
    write_checkpoint(folder / "a.h5", checkpoint_at(1.0));
    write_checkpoint(folder / "b.h5", checkpoint_at(1.0));
    EXPECT_EQ(read_file(folder / "a.h5"), read_file(folder / "b.h5"));
}

TEST(CheckpointFile, KeepsThePreviousOne) {
    const TemporaryFolder folder;
    for (const double time : {1.0, 2.0, 3.0}) {
        write_checkpoint(folder / "checkpoint.h5", checkpoint_at(time));
    }
    EXPECT_EQ(read(folder / "checkpoint.h5")->realisations[0]->number("time"), 3.0);
    EXPECT_EQ(read(folder / "checkpoint-previous.h5")->realisations[0]->number("time"), 2.0);
    EXPECT_EQ(folder.count(), 2U);
}

TEST(CheckpointFile, AnyTruncationFallsBackToThePrevious) {
    for (std::size_t part = 0; part < 50; ++part) {
        SCOPED_TRACE(std::to_string(part) + " of 50 parts are left");
        expect_fall_back([&](std::string& bytes) { bytes.resize(part * bytes.size() / 50); });
    }
    expect_fall_back([](std::string& bytes) { bytes.pop_back(); });
}

TEST(CheckpointFile, OneFlippedBitFallsBackToThePrevious) {
    for (const std::size_t place : {3U, 40U, 511U, 512U}) {
        expect_fall_back(
            [&](std::string& bytes) { bytes[place] = static_cast<char>(bytes[place] ^ 4); });
    }
    for (std::size_t part = 0; part < 50; ++part) {
        SCOPED_TRACE("after " + std::to_string(part) + " of 50 parts");
        expect_fall_back([&](std::string& bytes) {
            char& flipped = bytes[part * bytes.size() / 50];
            flipped = static_cast<char>(flipped ^ (1 << part % 8));
        });
    }
}

TEST(CheckpointFile, GarbageFallsBackToThePrevious) {
    expect_fall_back([](std::string& bytes) { bytes = "not a checkpoint"; });
}

TEST(CheckpointFile, AbsentNewestFallsBackToThePrevious) {
    const TemporaryFolder folder;
    write_checkpoint(folder / "checkpoint-previous.h5", checkpoint_at(1.0));
    std::string warning;
    EXPECT_TRUE(read_checkpoint(folder / "checkpoint.h5", "abc", warning));
    EXPECT_THAT(warning, HasSubstr("missing"));
}

TEST(CheckpointFile, NoneAtAllIsNoError) {
    const TemporaryFolder folder;
    EXPECT_FALSE(read(folder / "checkpoint.h5"));
}

TEST(CheckpointFile, TwoDamagedOnesAreAnErrorThatNamesTheFile) {
    const TemporaryFolder folder;
    write_file(folder / "checkpoint.h5", "garbage");
    write_file(folder / "checkpoint-previous.h5", "garbage");
    EXPECT_THAT(error_of([&] { read(folder / "checkpoint.h5"); }),
                AllOf(StartsWith("input/output: cannot read a checkpoint"),
                      HasSubstr((folder / "checkpoint.h5").string()),
                      HasSubstr("checkpoint-previous.h5"),
                      HasSubstr("without --resume")));
}

TEST(CheckpointFile, OtherSceneIsRefused) {
    const TemporaryFolder folder;
    write_checkpoint(folder / "checkpoint.h5", checkpoint_at(1.0));
    std::string warning;
    EXPECT_THAT(
        error_of([&] { read_checkpoint(folder / "checkpoint.h5", "other", warning); }),
        AllOf(StartsWith("bad input: the checkpoint belongs to another scene"), HasSubstr("-o")));
}

TEST(CheckpointFile, IsAnOrdinaryHdf5File) {
    const TemporaryFolder folder;
    write_checkpoint(folder / "checkpoint.h5", checkpoint_at(1.0));
    // Readers look for this signature at 0, 512, 1024, 2048 ... bytes.
    EXPECT_EQ(read_file(folder / "checkpoint.h5").substr(512, 8), "\x89HDF\r\n\x1A\n");
}

}  // namespace
}  // namespace grainbench::io
