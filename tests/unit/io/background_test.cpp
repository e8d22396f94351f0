// Tasks beside the stepping: their order, their errors, and that only one large one is held.
#include "io/background.hpp"

#include <gtest/gtest.h>

#include <future>
#include <stdexcept>
#include <vector>

namespace grainbench::test {
namespace {

using io::Background;

TEST(Background, DoesTasksInTheirOrder) {
    std::vector<int> done;
    Background background;
    for (int n = 0; n < 100; ++n) {
        background.post([&done, n] { done.push_back(n); });
    }
    background.drain();
    ASSERT_EQ(done.size(), 100U);
    for (int n = 0; n < 100; ++n) {
        EXPECT_EQ(done[static_cast<std::size_t>(n)], n);
    }
}

TEST(Background, GoesOnWhileATaskIsUnderWay) {
    std::promise<void> gate;
    Background background;
    bool is_done = false;
    background.post_large([&] {
        gate.get_future().wait();
        is_done = true;
    });
    background.post([] {});  // would never return if it waited for the first
    gate.set_value();
    background.make_room();
    EXPECT_TRUE(is_done);
}

TEST(Background, ThrowsWhatATaskHasThrownAndDoesNoOther) {
    Background background;
    bool was_next_done = false;
    background.post_large([] { throw std::runtime_error("disk full"); });
    try {
        background.post([&] { was_next_done = true; });
    } catch (const std::runtime_error&) {  // if the first was done by then
    }
    EXPECT_THROW(background.drain(), std::runtime_error);
    EXPECT_THROW(background.make_room(), std::runtime_error);
    EXPECT_THROW(background.post([] {}), std::runtime_error);
    EXPECT_FALSE(was_next_done);
}

TEST(Background, FinishesBeforeItEnds) {
    int done = 0;
    {
        Background background;
        for (int n = 0; n < 10; ++n) {
            background.post_large([&done] { ++done; });
        }
    }
    EXPECT_EQ(done, 10);
}

}  // namespace
}  // namespace grainbench::test
