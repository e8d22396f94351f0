#include "cli/progress.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace grainbench::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

EnsembleProgress at(double fraction, double wall_seconds) {
    return {.fraction = fraction,
            .particle_steps = 3e7 * wall_seconds,
            .wall_seconds = wall_seconds,
            .timestep = 1.25e-5,
            .time = 0.5};
}

/// Reports every hundredth of a second for the given time.
std::string said_in(double seconds, bool terminal, bool quiet) {
    std::ostringstream err;
    const Streams streams{.out = err, .err = err, .err_is_terminal = terminal};
    Progress progress(streams, quiet, 0.0);
    for (int k = 1; k <= static_cast<int>(100 * seconds); ++k) {
        progress.update(at(0.01 * k / seconds, 0.01 * k));
    }
    return err.str();
}

TEST(Progress, TextHasPercentRateStepAndTimeLeft) {
    EXPECT_THAT(progress_text(at(0.25, 60.0), 0.0),
                AllOf(HasSubstr(" 25.0 %"),
                      HasSubstr("t 0.5 s"),
                      HasSubstr("30.0 M particle-steps/s"),
                      HasSubstr("dt 1.25e-05 s"),
                      HasSubstr("left 3:00")));
}

TEST(Progress, TimeLeftOfAResumedRunCountsOnlyWhatIsDoneNow) {
    // 10 % in a minute, 40 % to go.
    EXPECT_THAT(progress_text(at(0.6, 60.0), 0.5), HasSubstr("left 4:00"));
    EXPECT_THAT(progress_text(at(0.5, 60.0), 0.5), Not(HasSubstr("left")));
}

TEST(Progress, DurationsReadAsAClock) {
    EXPECT_EQ(duration_text(0.4), "0:00");
    EXPECT_EQ(duration_text(65.2), "1:05");
    EXPECT_EQ(duration_text(3723.0), "1:02:03");
    EXPECT_EQ(duration_text(-1.0), "0:00");
}

TEST(Progress, TerminalLineIsRedrawnAtMostFiveTimesASecond) {
    const std::string said = said_in(2.0, true, false);
    const auto redrawn = std::count(said.begin(), said.end(), '%');
    EXPECT_LE(redrawn, 10);
    EXPECT_GE(redrawn, 9);
    EXPECT_THAT(said, Not(HasSubstr("\n")));
}

TEST(Progress, ElsewhereALogLineComesEveryTenSeconds) {
    const std::string said = said_in(35.0, false, false);
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 3);
    EXPECT_THAT(said, Not(HasSubstr("\r")));
}

TEST(Progress, QuietSaysNothing) {
    EXPECT_THAT(said_in(35.0, false, true), IsEmpty());
    EXPECT_THAT(said_in(2.0, true, true), IsEmpty());
}

}  // namespace
}  // namespace grainbench::cli
