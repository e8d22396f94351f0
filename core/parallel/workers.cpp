#include "core/parallel/workers.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <algorithm>

#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#endif

namespace grainbench {

namespace {

/// Tells the thread sanitizer, which does not see into oneTBB, that all parts begin after the call
/// and end before it returns. Between the parts themselves it orders nothing.
class SeenOrder {
public:
#ifdef __SANITIZE_THREAD__
    SeenOrder() {
        __tsan_release(&start_);
    }

    ~SeenOrder() {
        __tsan_acquire(&end_);
    }

    void begin_part() {
        __tsan_acquire(&start_);
    }

    void end_part() {
        __tsan_release(&end_);
    }

private:
    char start_ = 0;
    char end_ = 0;
#else
    void begin_part() {}

    void end_part() {}
#endif
};

}  // namespace

struct Workers::Pool {
    explicit Pool(unsigned threads)
        : most(tbb::global_control::max_allowed_parallelism,
               std::max<std::size_t>(threads,
                                     tbb::global_control::active_value(
                                         tbb::global_control::max_allowed_parallelism))),
          arena(static_cast<int>(threads)) {}

    /// Else oneTBB complains of more threads than there are cores. Never less than what is allowed
    /// already, which is for the whole process.
    tbb::global_control most;
    tbb::task_arena arena;
};

Workers::Workers(unsigned threads) {
    if (threads > 1) {
        pool_ = std::make_shared<Pool>(threads);
    }
}

void Workers::share_out(std::size_t count, const std::function<void(std::size_t)>& act) const {
    SeenOrder order;
    const auto seen_act = [&](std::size_t part) {
        order.begin_part();
        act(part);
        order.end_part();
    };
    pool_->arena.execute(
        [&] { tbb::parallel_for(std::size_t{0}, count, seen_act, tbb::simple_partitioner()); });
}

}  // namespace grainbench
