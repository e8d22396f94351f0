#include "cli/interrupt.hpp"

#include <csignal>

namespace grainbench::cli {
namespace {

std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler writes it");

extern "C" void on_signal(int) {
    interrupted = true;
}

}  // namespace

struct Interrupt::Saved {
    struct sigaction on_interrupt {};

    struct sigaction on_terminate {};
};

Interrupt::Interrupt() : saved_(std::make_unique<Saved>()) {
    interrupted = false;

    struct sigaction action {};

    action.sa_handler = on_signal;
    // Back to the default after the first; system calls go on, so that no write is cut short.
    action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, &saved_->on_interrupt);
    sigaction(SIGTERM, &action, &saved_->on_terminate);
}

Interrupt::~Interrupt() {
    sigaction(SIGINT, &saved_->on_interrupt, nullptr);
    sigaction(SIGTERM, &saved_->on_terminate, nullptr);
}

const std::atomic<bool>& Interrupt::requested() const {
    return interrupted;
}

}  // namespace grainbench::cli
