/// Threads that share the work on one scene. Loops are cut into parts that depend on the scene
/// alone, never on the number of threads, and every part writes to places of its own: so the bits
/// are the same for any number of threads (share/doc/determinism.md).
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace grainbench {

class Workers {
public:
    /// The calling thread alone.
    Workers() = default;

    explicit Workers(unsigned threads);

    /// Calls act(part) for each part below `count`, in no order, and returns when all are done.
    template <class Act>
    void for_each(std::size_t count, const Act& act) const {
        if (pool_ == nullptr || count < 2) {
            for (std::size_t part = 0; part < count; ++part) {
                act(part);
            }
        } else {
            share_out(count, std::cref(act));
        }
    }

private:
    struct Pool;

    void share_out(std::size_t count, const std::function<void(std::size_t)>& act) const;

    std::shared_ptr<Pool> pool_;
};

}  // namespace grainbench
