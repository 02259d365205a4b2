#include "contact/near_corners.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "contact/near_corners.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <limits>

#include "contact/capsule.h"
#include "simd/lanes-inl.h"
#include "simd/target.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void find_near(std::span<const Vector2> places, std::uint64_t corners, const FaceSegment& segment, double squared_range,
               NearCorners& found) {
  using D = hn::CappedTag<double, kPointLot>;
  const D d;
  const auto axis_x = hn::Set(d, segment.axis.x());
  const auto axis_y = hn::Set(d, segment.axis.y());
  const auto most = hn::Set(d, std::numeric_limits<double>::max());
  auto least = most;
  std::uint64_t near = 0;
  for (std::size_t i = 0; i < places.size(); i += hn::Lanes(d)) {
    const Points<D> place = load_points(d, &places[i]);
    const auto x = hn::Sub(place.x, hn::Set(d, segment.start.x()));
    const auto y = hn::Sub(place.y, hn::Set(d, segment.start.y()));
    const auto ahead = hn::Add(hn::Mul(x, axis_x), hn::Mul(y, axis_y));
    const auto along = hn::Min(hn::Max(ahead, hn::Zero(d)), hn::Set(d, segment.length));
    const auto off_x = hn::Sub(x, hn::Mul(along, axis_x));
    const auto off_y = hn::Sub(y, hn::Mul(along, axis_y));
    const auto squared = hn::Add(hn::Mul(off_x, off_x), hn::Mul(off_y, off_y));
    hn::StoreU(squared, d, &found.squared_distance[i]);
    const auto is_near = hn::Lt(squared, hn::Set(d, squared_range));
    near |= std::uint64_t{bits_of(d, is_near)} << i;
    const std::uint8_t counted = static_cast<std::uint8_t>(corners >> i);
    const auto is_other = hn::AndNot(is_near, hn::LoadMaskBits(d, &counted));
    least = hn::Min(least, hn::IfThenElse(is_other, squared, most));
  }
  found.near = near & corners;
  found.least_of_others = hn::GetLane(hn::MinOfLanes(d, least));
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cellcrush {
namespace {

void find_near_plain(std::span<const Vector2> places, std::uint64_t corners, const FaceSegment& segment,
                     double squared_range, NearCorners& found) {
  found.near = 0;
  found.least_of_others = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double squared = project(places[i], segment.start, segment.axis, segment.length).offset.squaredNorm();
    found.squared_distance[i] = squared;
    const std::uint64_t bit = std::uint64_t{1} << i;
    if ((corners & bit) == 0) {
      continue;
    }
    if (squared < squared_range) {
      found.near |= bit;
    } else {
      found.least_of_others = std::min(found.least_of_others, squared);
    }
  }
}

}  // namespace

HWY_EXPORT(find_near);

void find_near_corners(std::span<const Vector2> places, std::uint64_t corners, const FaceSegment& segment,
                       double squared_range, NearCorners& found) {
  use_wide_kernels() ? HWY_DYNAMIC_DISPATCH(find_near)(places, corners, segment, squared_range, found)
                     : find_near_plain(places, corners, segment, squared_range, found);
}

}  // namespace cellcrush
#endif
