#include "search/velocity_box.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "search/velocity_box.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

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

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cellcrush {

HWY_EXPORT(find_box);

VelocityBox box_of_velocities(const State& state, std::span<const int> members) {
  return HWY_DYNAMIC_DISPATCH(find_box)(state.velocity.data(), members);
}

}  // namespace cellcrush
#endif
