// Vectors for large tables that are read at random.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <new>
#include <vector>

namespace airsim360 {

/// Starts every table on a cache line, and large ones on a huge page that the system is asked to use: a table
/// of hundreds of MiB otherwise misses the TLB at nearly every access.
template <class T>
struct TableAllocator {
  using value_type = T;

  TableAllocator() = default;
  template <class U>
  TableAllocator(const TableAllocator<U>&) {}

  T* allocate(size_t count) {
    constexpr size_t kLine = 64, kHugePage = size_t{2} << 20;
    if (count > static_cast<size_t>(-1) / 2 / sizeof(T)) throw std::bad_array_new_length();
    const size_t unit = count * sizeof(T) < 2 * kHugePage ? kLine : kHugePage;
    const size_t bytes = (count * sizeof(T) + unit - 1) / unit * unit;
    void* memory = std::aligned_alloc(unit, bytes);
    if (memory == nullptr) throw std::bad_alloc();
    if (unit == kHugePage) madvise(memory, bytes, MADV_HUGEPAGE);  // a wish: nothing depends on it
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, size_t) { std::free(memory); }

  friend bool operator==(const TableAllocator&, const TableAllocator&) { return true; }
};

template <class T>
using TableVector = std::vector<T, TableAllocator<T>>;

}  // namespace airsim360
