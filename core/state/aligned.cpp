#include "core/state/aligned.hpp"

#include <sys/mman.h>

#include <cstdint>
#include <new>

namespace grainbench {

namespace {

constexpr std::size_t cache_line = 64;
constexpr std::size_t large_page = 2U << 20U;

/// Only whole large pages are asked for, so that no column takes more memory than it needs.
constexpr std::size_t large_from = 2 * large_page;

/// Rows of all columns would fall into the same sets of the caches if columns began alike.
constexpr std::size_t stagger = 4096 + 4 * cache_line;
constexpr std::size_t most_staggered = 13 * stagger;

}  // namespace

void* allocate_column(std::size_t bytes) {
    if (bytes < large_from) {
        return ::operator new (bytes, std::align_val_t{cache_line});
    }
    auto* const page = static_cast<std::byte*>(
        ::operator new (bytes + most_staggered, std::align_val_t{large_page}));
    // A wish: where the system has no such pages, the others do.
    static_cast<void>(madvise(page, bytes / large_page * large_page, MADV_HUGEPAGE));
    const std::size_t number = reinterpret_cast<std::uintptr_t>(page) / large_page;
    return page + number % (most_staggered / stagger) * stagger;
}

void deallocate_column(void* p, std::size_t bytes) {
    if (bytes < large_from) {
        ::operator delete (p, std::align_val_t{cache_line});
    } else {
        const auto address = reinterpret_cast<std::uintptr_t>(p);
        ::operator delete (reinterpret_cast<void*>(address - address % large_page),
                           std::align_val_t{large_page});
    }
}

}  // namespace grainbench
