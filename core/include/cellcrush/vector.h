#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <new>
#include <span>
#include <vector>

namespace cellcrush {

/// A vector in the plane of the lattice.
using Vector2 = Eigen::Vector2d;

/// z component of the cross product: positive if `b` points counter-clockwise of `a`.
EIGEN_DEVICE_FUNC inline double cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// `a` rotated by 90 degrees counter-clockwise.
EIGEN_DEVICE_FUNC inline Vector2 normal_of(const Vector2& a) { return {-a.y(), a.x()}; }

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

/// Whether all numbers are finite. Only a non-finite number keeps the sum of the products with 0 from being 0.
inline bool all_finite(std::span<const double> numbers) {
  return (0.0 * Eigen::Map<const Eigen::ArrayXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()))).sum() ==
         0.0;
}

inline bool all_finite(std::span<const Vector2> points) {
  return points.empty() || all_finite({points.front().data(), 2 * points.size()});
}

}  // namespace cellcrush
