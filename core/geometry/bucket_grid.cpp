#include "geometry/bucket_grid.h"

#include <cmath>
#include <numeric>

namespace cellcrush {

BucketGrid::BucketGrid(std::span<const Vector2> points, double size) : origin_(points.front()), size_(size) {
  Vector2 high = points.front();
  for (const Vector2& point : points) {
    origin_ = origin_.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const Vector2 extent = high - origin_;
  const double most = kBucketsPerPoint * static_cast<double>(points.size()) + 16.0;
  while ((extent.x() / size_ + 1.0) * (extent.y() / size_ + 1.0) > most) {
    size_ *= 2.0;
  }
  columns_ = cell(high, 0) + 1;
  rows_ = cell(high, 1) + 1;

  offset_.assign(static_cast<std::size_t>(columns_) * rows_ + 1, 0);
  std::vector<std::size_t> home(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    home[i] = bucket(cell(points[i], 0), cell(points[i], 1));
    ++offset_[home[i] + 1];
  }
  std::partial_sum(offset_.begin(), offset_.end(), offset_.begin());
  sorted_.resize(points.size());
  std::vector<int> next(offset_.begin(), offset_.end() - 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    sorted_[next[home[i]]++] = static_cast<int>(i);
  }
}

// Queries may lie far outside the grid, where the floor would overflow an int. They are clamped to one bucket beyond
// its edge.
int BucketGrid::cell(const Vector2& point, int axis) const {
  return static_cast<int>(std::clamp(std::floor((point[axis] - origin_[axis]) / size_), -1.0, 2e9));
}

}  // namespace cellcrush
