#include "contact/wide_plates.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "contact/wide_plates.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class D>
HWY_INLINE hn::Mask<D> reaches_plate(D d, const Scene& scene, const State& state, const PlateFaces& faces,
                                     std::size_t i) {
  const Points<D> position = load_points(d, &state.position[i]);
  const auto place = scene.plates.axis == 0 ? position.x : position.y;
  const auto radius = hn::LoadU(d, &scene.radius[i]);
  auto reaches = hn::Or(hn::Lt(hn::Sub(place, radius), hn::Set(d, faces.impact)),
                        hn::Gt(hn::Add(place, radius), hn::Set(d, faces.support)));
  if (!state.impact_friction.empty()) {
    const auto zero = hn::Zero(d);
    reaches = hn::Or(reaches, hn::Or(hn::Ne(hn::LoadU(d, &state.impact_friction[i]), zero),
                                     hn::Ne(hn::LoadU(d, &state.support_friction[i]), zero)));
  }
  return reaches;
}

std::size_t find_near_plates(const Scene& scene, const State& state, const PlateFaces& faces, std::size_t first,
                             std::size_t end, int* near) {
  const hn::CappedTag<double, 8> wide;
  const hn::CappedTag<double, 1> one;
  std::size_t count = 0;
  std::size_t i = first;
  for (; i + hn::Lanes(wide) <= end; i += hn::Lanes(wide)) {
    count += write_set_lanes(wide, reaches_plate(wide, scene, state, faces, i), i, near + count);
  }
  for (; i < end; ++i) {
    count += write_set_lanes(one, reaches_plate(one, scene, state, faces, i), i, near + count);
  }
  return count;
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cellcrush {

HWY_EXPORT(find_near_plates);

std::size_t find_near_plates_wide(const Scene& scene, const State& state, const PlateFaces& faces, std::size_t first,
                                  std::size_t end, int* near) {
  return HWY_DYNAMIC_DISPATCH(find_near_plates)(scene, state, faces, first, end, near);
}

}  // namespace cellcrush
#endif
