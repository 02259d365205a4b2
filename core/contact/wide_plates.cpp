#include "contact/wide_plates.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "contact/wide_plates.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <limits>

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

/// Where the largest ball would reach into a plate, for places as they lie in memory, x and y in turn; never across the crush.
template <class D>
struct FarReach {
  hn::Vec<D> below;
  hn::Vec<D> above;

  FarReach(D d, const Scene& scene, const PlateFaces& faces) {
    constexpr double kNever = std::numeric_limits<double>::infinity();
    double low[hn::MaxLanes(D())];
    double high[hn::MaxLanes(D())];
    for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
      const bool along = static_cast<int>(lane % 2) == scene.plates.axis;
      low[lane] = along ? faces.impact + scene.largest_radius : -kNever;
      high[lane] = along ? faces.support - scene.largest_radius : kNever;
    }
    below = hn::LoadU(d, low);
    above = hn::LoadU(d, high);
  }

  /// Whether one of as many places as there are lanes may reach.
  [[nodiscard]] HWY_INLINE bool has_some(D d, const Vector2* places) const {
    if constexpr (hn::MaxLanes(D()) == 1) {
      return true;
    }
    const auto first = hn::LoadU(d, places->data());
    const auto second = hn::LoadU(d, places->data() + hn::Lanes(d));
    const auto some = hn::Or(hn::Or(hn::Lt(first, below), hn::Gt(first, above)),
                             hn::Or(hn::Lt(second, below), hn::Gt(second, above)));
    return !hn::AllFalse(d, some);
  }
};

std::size_t find_near_plates(const Scene& scene, const State& state, const PlateFaces& faces, std::size_t first,
                             std::size_t end, int* near) {
  const hn::CappedTag<double, 8> wide;
  const hn::CappedTag<double, 1> one;
  const FarReach<decltype(wide)> far(wide, scene, faces);
  const bool may_rub = !state.impact_friction.empty();
  std::size_t count = 0;
  std::size_t i = first;
  for (; i + hn::Lanes(wide) <= end; i += hn::Lanes(wide)) {
    if (may_rub || far.has_some(wide, &state.position[i])) {
      count += write_set_lanes(wide, reaches_plate(wide, scene, state, faces, i), i, near + count);
    }
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
