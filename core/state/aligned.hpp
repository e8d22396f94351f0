/// Columns whose start suits every vector width and that never share a cache line.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace grainbench {

template <class T>
struct CacheLineAllocator {
    using value_type = T;
    static constexpr std::align_val_t alignment{64};

    CacheLineAllocator() = default;

    template <class U>
    CacheLineAllocator(const CacheLineAllocator<U>&) {}

    T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), alignment)); }

    void deallocate(T* p, std::size_t) { ::operator delete(p, alignment); }

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
