#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "cellcrush/vector.h"

namespace cellcrush {

/// Points sorted into square buckets, after the NBS search of Munjiza and Andrews (1998). Time and memory grow in
/// proportion to the number of points, whatever area they cover.
///
/// Deviation from Eq. 40: the bucket number is the floor of the coordinate. Truncation toward zero would merge two
/// buckets at the origin.
class BucketGrid {
 public:
  static constexpr double kBucketsPerPoint = 4.0;

  /// `size` is the wanted side of a bucket in mm. It is enlarged where there would be more than kBucketsPerPoint
  /// buckets per point. REQUIRES: at least one point, finite coordinates, size > 0.
  BucketGrid(std::span<const Vector2> points, double size);

  /// Calls visit(point index) for every point in the buckets that the box from `low` to `high` overlaps.
  template <class Visit>
  void visit_box(const Vector2& low, const Vector2& high, Visit&& visit) const {
    const int x_first = std::max(cell(low, 0), 0);
    const int x_last = std::min(cell(high, 0), columns_ - 1);
    const int y_first = std::max(cell(low, 1), 0);
    const int y_last = std::min(cell(high, 1), rows_ - 1);
    if (x_first > x_last) return;
    for (int y = y_first; y <= y_last; ++y) {
      for (int k = offset_[bucket(x_first, y)]; k < offset_[bucket(x_last, y) + 1]; ++k) {
        visit(sorted_[k]);
      }
    }
  }

  [[nodiscard]] double bucket_size() const { return size_; }

 private:
  /// Column (axis 0) or row (axis 1) of a point.
  [[nodiscard]] int cell(const Vector2& point, int axis) const;
  [[nodiscard]] std::size_t bucket(int x, int y) const { return static_cast<std::size_t>(y) * columns_ + x; }

  Vector2 origin_;
  double size_;
  int columns_;
  int rows_;
  std::vector<int> offset_;  // into sorted_, one per bucket, then the end
  std::vector<int> sorted_;  // points, bucket by bucket
};

}  // namespace cellcrush
