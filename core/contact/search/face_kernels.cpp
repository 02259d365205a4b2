#include "contact/search/face_pairs.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "contact/search/face_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <limits>

#include "contact/touch_geometry-inl.h"
#include "simd/points-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// REQUIRES: at least as many members as lanes.
template <class D>
HWY_INLINE VelocityBox box_of(const Vector2* velocities, std::span<const int> members) {
  constexpr std::size_t kWidth = Lane<D>::kWidth;
  Points<D> low = gather<D>(velocities, members.data());
  Points<D> high = low;
  for (std::size_t i = kWidth; i < members.size(); i += kWidth) {
    // The last members may be loaded twice.
    const Points<D> velocity = gather<D>(velocities, &members[std::min(i, members.size() - kWidth)]);
    // The velocity comes first: a minimum instruction overwrites its first operand.
    low = min(velocity, low);
    high = max(velocity, high);
  }
  return {{least_of_lanes(low.x), least_of_lanes(low.y)}, {greatest_of_lanes(high.x), greatest_of_lanes(high.y)}};
}

VelocityBox find_box(const Vector2* velocities, std::span<const int> members) {
  using Wide = WideTag<double, 8>;
  using One = hn::CappedTag<double, 1>;
  return members.size() < Lane<Wide>::kWidth ? box_of<One>(velocities, members) : box_of<Wide>(velocities, members);
}

void find_near(std::span<const Vector2> places, std::size_t count, const FaceSegment& segment, double squared_range,
               NearCorners& found) {
  using D = WideTag<double, kPointTile>;
  const Points<D> start = {segment.start.x(), segment.start.y()};
  const Points<D> axis = {segment.axis.x(), segment.axis.y()};
  const Lane<D> length = segment.length;
  const Lane<D> most = std::numeric_limits<double>::max();
  Lane<D> least = most;
  std::uint64_t near = 0;
  for (std::size_t i = 0; i < places.size(); i += Lane<D>::kWidth) {
    const Points<D> from_start = Points<D>::load(&places[i]) - start;
    const Offset<Lane<D>> off = project_clamped(from_start.x, from_start.y, axis.x, axis.y, length);
    const Lane<D> squared = off.x * off.x + off.y * off.y;
    squared.store(&found.squared_distance[i]);
    const auto is_near = squared < squared_range;
    near |= std::uint64_t{bits_of(is_near)} << i;
    least = min(least, select(is_near, most, squared));
  }
  found.near = near & ~std::uint64_t{0} >> (kManyCorners - count);
  found.least_of_others = least_of_lanes(least);
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cellcrush {

HWY_EXPORT(find_box);
HWY_EXPORT(find_near);

VelocityBox box_of_velocities(const State& state, std::span<const int> members) {
  return HWY_DYNAMIC_DISPATCH(find_box)(state.velocity.data(), members);
}

void find_near_corners(std::span<const Vector2> places, std::size_t count, const FaceSegment& segment,
                       double squared_range, NearCorners& found) {
  HWY_DYNAMIC_DISPATCH(find_near)(places, count, segment, squared_range, found);
}

}  // namespace cellcrush
#endif
