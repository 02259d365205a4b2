#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace cellcrush {

/// Allocates memory aligned to the widest vector register and to a cache line, so that no load of a full block crosses
/// a line.
template <class T>
struct LaneAllocator {
  using value_type = T;
  static constexpr std::align_val_t kAlignment{64};

  LaneAllocator() = default;
  template <class U>
  LaneAllocator(const LaneAllocator<U>&) {}

  T* allocate(std::size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), kAlignment)); }
  void deallocate(T* values, std::size_t) { ::operator delete(values, kAlignment); }

  friend bool operator==(const LaneAllocator&, const LaneAllocator&) { return true; }
};

/// An aligned array. Values of elements are stored row by row, block by block (beam/element_place.h).
template <class T>
using LaneVector = std::vector<T, LaneAllocator<T>>;

}  // namespace cellcrush
