#include "io/atomic_file.hpp"
#include "io/hdf5/history.hpp"

#include "tests/unit/io/frames.hpp"
#include "tests/unit/io/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace grainbench::io {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

const std::vector<HistoryColumn> columns{{"time", "s", "simulated time"},
                                         {"cycle", "1", "number of the cycle"},
                                         {"force/lid, top %", "N", "force on \"lid\" \xC3\xBC"}};

RealisationHistory some_rows(std::int64_t seed, std::size_t rows) {
    RealisationHistory result;
    result.seed = seed;
    for (std::size_t k = 0; k < rows; ++k) {
        const auto x = static_cast<double>(k);
        result.history.append(columns, std::vector<double>{0.1 * x, 10 * x, -x});
    }
    result.traces = some_traces(2, {0.0, 0.5});
    return result;
}

History some_history() {
    return {.program = "grainbench 1.2.3",
            .scene = std::string(100'000, 'x') + "\xC3\xBC",  // beyond 64 KiB of plain attributes
            .scene_hash = "abc",
            .realisations = {some_rows(1, 3), some_rows(2, 0), some_rows(3, 1)}};
}

TEST(HistoryFile, ReadsBackTheSame) {
    const TemporaryFolder folder;
    const History expected = some_history();
    write_history(folder / "history.h5", expected);
    const History found = read_history(folder / "history.h5");
    EXPECT_EQ(found.program, expected.program);
    EXPECT_EQ(found.scene, expected.scene);
    EXPECT_EQ(found.scene_hash, expected.scene_hash);
    ASSERT_EQ(found.realisations.size(), 3U);
    for (std::size_t k = 0; k < 3; ++k) {
        const RealisationHistory& a = found.realisations[k];
        const RealisationHistory& b = expected.realisations[k];
        EXPECT_EQ(a.seed, b.seed);
        EXPECT_EQ(a.history.values, b.history.values);
        ASSERT_EQ(a.history.columns.size(), b.history.columns.size());
        for (std::size_t c = 0; c < a.history.columns.size(); ++c) {
            EXPECT_EQ(a.history.columns[c].name, b.history.columns[c].name);
            EXPECT_EQ(a.history.columns[c].unit, b.history.columns[c].unit);
            EXPECT_EQ(a.history.columns[c].doc, b.history.columns[c].doc);
        }
        EXPECT_EQ(a.traces.time, b.traces.time);
        ASSERT_EQ(a.traces.points.size(), 4U);
        for (std::size_t p = 0; p < 4; ++p) {
            EXPECT_EQ(a.traces.points[p].id, b.traces.points[p].id);
            EXPECT_EQ(a.traces.points[p].position, b.traces.points[p].position);
            EXPECT_EQ(a.traces.points[p].velocity, b.traces.points[p].velocity);
        }
    }
}

TEST(HistoryFile, SameHistoryGivesSameBytes) {
    const TemporaryFolder folder;
    write_history(folder / "a.h5", some_history());
    write_history(folder / "b.h5", some_history());
    EXPECT_EQ(read_file(folder / "a.h5"), read_file(folder / "b.h5"));
}

TEST(HistoryFile, ColumnsAreFoundByName) {
    const HistoryTable table = some_rows(1, 3).history;
    EXPECT_THAT(table.column("cycle"), ElementsAre(0.0, 10.0, 20.0));
    EXPECT_THAT(error_of([&] { table.column("cycles"); }),
                AllOf(StartsWith("bad input: "), HasSubstr("'cycles'"), HasSubstr("time, cycle")));
}

TEST(HistoryFile, DamagedOneIsAnErrorThatNamesItAndPrintsNothing) {
    const TemporaryFolder folder;
    write_history(folder / "history.h5", some_history());
    const std::string whole = read_file(folder / "history.h5");
    std::string flipped = whole;
    flipped[flipped.size() / 2] = static_cast<char>(flipped[flipped.size() / 2] ^ 1);
    testing::internal::CaptureStderr();
    for (const std::string& bytes : {std::string(),
                                     std::string("garbage"),
                                     whole.substr(0, 300),
                                     flipped,
                                     whole.substr(0, whole.size() / 2)}) {
        write_file(folder / "history.h5", bytes);
        EXPECT_THAT(
            error_of([&] { read_history(folder / "history.h5"); }),
            AllOf(StartsWith("input/output: "), HasSubstr((folder / "history.h5").string())));
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(HistoryFile, BecomesOneTableOfText) {
    const TemporaryFolder folder;
    write_history_csv(folder / "history.csv", some_history());
    EXPECT_EQ(read_file(folder / "history.csv"),
              "realisation,time,cycle,\"force/lid, top %\"\n"
              "1,0,0,-0\n"
              "1,0.1,10,-1\n"
              "1,0.2,20,-2\n"
              "3,0,0,-0\n");
}

}  // namespace
}  // namespace grainbench::io
