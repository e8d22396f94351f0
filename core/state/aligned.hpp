/// Columns whose start suits every vector width and that never share a cache line. Large ones ask
/// the system for large pages, of which a processor needs to look up fewer.
#pragma once

#include <cstddef>
#include <vector>

namespace grainbench {

/// Room that no column shares a cache line with. Throws std::bad_alloc.
void* allocate_column(std::size_t bytes);

/// \param bytes as they were asked for
void deallocate_column(void* p, std::size_t bytes);

template <class T>
struct CacheLineAllocator {
    using value_type = T;

    CacheLineAllocator() = default;

    template <class U>
    CacheLineAllocator(const CacheLineAllocator<U>&) {}

    T* allocate(std::size_t n) { return static_cast<T*>(allocate_column(n * sizeof(T))); }

    void deallocate(T* p, std::size_t n) { deallocate_column(p, n * sizeof(T)); }

    friend bool operator==(const CacheLineAllocator&, const CacheLineAllocator&) { return true; }
};

template <class T>
using Column = std::vector<T, CacheLineAllocator<T>>;

/// Gives work space back that is too large to be kept between its uses; what is left is empty.
/// Small work space stays, because asking for it again costs more than it takes.
template <class Container>
void release_if_large(Container& work_space) {
    constexpr std::size_t largest_kept = 8U << 20U;  // bytes
    if (work_space.capacity() * sizeof(typename Container::value_type) > largest_kept) {
        work_space = Container();
    }
}

}  // namespace grainbench
