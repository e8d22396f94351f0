#include "core/parallel/workers.hpp"

#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

namespace grainbench {

struct Workers::Pool {
    explicit Pool(unsigned threads) : arena(static_cast<int>(threads)) {}

    tbb::task_arena arena;
};

Workers::Workers(unsigned threads) {
    if (threads > 1) {
        pool_ = std::make_shared<Pool>(threads);
    }
}

void Workers::share_out(std::size_t count, const std::function<void(std::size_t)>& act) const {
    pool_->arena.execute(
        [&] { tbb::parallel_for(std::size_t{0}, count, act, tbb::simple_partitioner()); });
}

}  // namespace grainbench
