#include "contact/wide_velocities.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "contact/wide_velocities.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

VelocityBox box_of_velocities(const State& state, std::span<const int> members) {
  const hn::CappedTag<double, 8> d;
  const Vector2* velocities = state.velocity.data();
  const Vector2& first = velocities[members.front()];
  Points<decltype(d)> low = {hn::Set(d, first.x()), hn::Set(d, first.y())};
  Points<decltype(d)> high = low;
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= members.size(); i += hn::Lanes(d)) {
    const auto velocity = gather_points(d, velocities, &members[i]);
    low = {hn::Min(velocity.x, low.x), hn::Min(velocity.y, low.y)};
    high = {hn::Max(velocity.x, high.x), hn::Max(velocity.y, high.y)};
  }
  const auto least = [&](auto lanes) HWY_ATTR { return hn::GetLane(hn::MinOfLanes(d, lanes)); };
  const auto greatest = [&](auto lanes) HWY_ATTR { return hn::GetLane(hn::MaxOfLanes(d, lanes)); };
  VelocityBox box = {{least(low.x), least(low.y)}, {greatest(high.x), greatest(high.y)}};
  for (; i < members.size(); ++i) {
    box.low = velocities[members[i]].cwiseMin(box.low);
    box.high = velocities[members[i]].cwiseMax(box.high);
  }
  return box;
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cellcrush {

HWY_EXPORT(box_of_velocities);

VelocityBox box_of_velocities_wide(const State& state, std::span<const int> members) {
  return HWY_DYNAMIC_DISPATCH(box_of_velocities)(state, members);
}

}  // namespace cellcrush
#endif
