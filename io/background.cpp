#include "io/background.hpp"

#include <utility>

namespace grainbench::io {

Background::~Background() {
    {
        const std::scoped_lock lock(mutex_);
        stops_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) {
        thread_.join();
    }
}

void Background::make_room() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return large_ == 0; });
    throw_failure();
}

void Background::post(std::function<void()> task) {
    post(Task{.act = std::move(task), .is_large = false});
}

void Background::post_large(std::function<void()> task) {
    post(Task{.act = std::move(task), .is_large = true});
}

void Background::post(Task task) {
    {
        const std::scoped_lock lock(mutex_);
        throw_failure();
        large_ += task.is_large ? 1 : 0;
        tasks_.push_back(std::move(task));
        if (!thread_.joinable()) {
            thread_ = std::thread([this] { work(); });
        }
    }
    changed_.notify_all();
}

void Background::drain() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return tasks_.empty(); });
    throw_failure();
}

void Background::throw_failure() const {
    if (failure_) {
        std::rethrow_exception(failure_);
    }
}

void Background::work() {
    std::unique_lock lock(mutex_);
    for (;;) {
        changed_.wait(lock, [&] { return stops_ || !tasks_.empty(); });
        if (tasks_.empty()) {
            return;
        }
        if (!failure_) {
            const std::function<void()> act = std::move(tasks_.front().act);
            lock.unlock();
            std::exception_ptr failure;
            try {
                act();
            } catch (...) {
                failure = std::current_exception();
            }
            lock.lock();
            failure_ = failure;
        }
        large_ -= tasks_.front().is_large ? 1 : 0;
        tasks_.pop_front();
        changed_.notify_all();
    }
}

}  // namespace grainbench::io
