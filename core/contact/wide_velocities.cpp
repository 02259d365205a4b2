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
  const Vector2* velocities = state.velocity.data();
  VelocityBox box = {velocities[members.front()], velocities[members.front()]};
  std::size_t i = 0;
#if HWY_TARGET != HWY_SCALAR
  // x and y in turn, as they lie: nothing parts them.
  const hn::CappedTag<double, 8> d;
  constexpr std::size_t kPoints = hn::MaxLanes(d) / 2;
  auto low = hn::LoadDup128(d, box.low.data());
  auto high = low;
  for (; i + kPoints <= members.size(); i += kPoints) {
    const auto velocity = load_half(d, velocities, &members[i]);
    low = hn::Min(velocity, low);
    high = hn::Max(velocity, high);
  }
  Vector2 lows[kPoints];
  Vector2 highs[kPoints];
  hn::StoreU(low, d, lows[0].data());
  hn::StoreU(high, d, highs[0].data());
  for (std::size_t k = 0; k < kPoints; ++k) {
    box.low = lows[k].cwiseMin(box.low);
    box.high = highs[k].cwiseMax(box.high);
  }
#endif
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
