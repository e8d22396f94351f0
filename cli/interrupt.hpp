/// Turns SIGINT and SIGTERM into a flag while it lives, so that a run can stop at a good moment.
/// The second signal ends the program at once.
#pragma once

#include <atomic>
#include <memory>

namespace grainbench::cli {

class Interrupt {
public:
    Interrupt();
    ~Interrupt();
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;

    const std::atomic<bool>& requested() const;

private:
    struct Saved;
    std::unique_ptr<Saved> saved_;
};

}  // namespace grainbench::cli
