/// Tasks done one after the other on a thread of their own, so that stepping does not wait for
/// files.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace grainbench::io {

/// May be used from any thread. The order of tasks is that in which they were posted.
class Background {
public:
    Background() = default;

    /// Finishes what was posted; errors that nobody asked for are lost.
    ~Background();
    Background(const Background&) = delete;
    Background& operator=(const Background&) = delete;

    /// Waits until no large task is left, so that each thread that posts has one in memory at most.
    /// Throws what a task has thrown, after which no other is done.
    void make_room();

    void post(std::function<void()> task);

    /// \param task that holds as much as a frame; call make_room() before the frame is made
    void post_large(std::function<void()> task);

    /// Waits until all is done. Throws what a task has thrown.
    void drain();

private:
    struct Task {
        std::function<void()> act;
        bool is_large = false;
    };

    void post(Task task);
    void work();
    void throw_failure() const;

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Task> tasks_;  ///< the first is under way
    std::size_t large_ = 0;   ///< of them
    std::exception_ptr failure_;
    bool stops_ = false;
    std::thread thread_;  ///< from the first task on
};

}  // namespace grainbench::io
