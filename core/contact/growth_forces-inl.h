// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_CONTACT_GROWTH_FORCES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_CONTACT_GROWTH_FORCES_INL_H_
#undef CELLCRUSH_CONTACT_GROWTH_FORCES_INL_H_
#else
#define CELLCRUSH_CONTACT_GROWTH_FORCES_INL_H_
#endif

#include <algorithm>
#include <utility>

#include "contact/contact_tiles.h"
#include "contact/start_overlaps.h"
#include "contact/thickening.h"
#include "contact/touch_geometry-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// Adds a force to the end of an element and its reverse to the start.
template <class S>
HWY_INLINE void push_ends(const Scene& scene, S& state, int element, const Vector2& on_end) {
  const Element& ends = scene.elements[element];
  state.contact_force[ends.end].elastic += on_end;
  state.contact_force[ends.start].elastic -= on_end;
  mark_contact_tile(state, ends.start);
  mark_contact_tile(state, ends.end);
}

/// The ball is pushed towards the thinner end by the derivative of the reach by the foot's place; `taper` is what the
/// reach is more at the segment's end than at its start. The couple of this force and its reaction on the mid-line is
/// that of two forces across the segment.
template <class S>
HWY_INLINE void push_along(const Scene& scene, S& state, const GrownTouch& touch, double taper) {
  const Element& ends = scene.elements[touch.segment];
  const double inverse_length = state.inverse_length[touch.segment];
  const Vector2& axis = state.axis[touch.segment];
  const double slope = 6.0 * touch.share * (1.0 - touch.share);  // of share_of_end
  const double along = touch.force * slope * taper * inverse_length;
  state.contact_force[touch.ball].elastic -= along * axis;
  state.contact_force[ends.start].elastic += (1.0 - touch.share) * along * axis;
  state.contact_force[ends.end].elastic += touch.share * along * axis;
  push_ends(scene, state, touch.segment, -along * touch.offset * inverse_length * Vector2(-axis.y(), axis.x()));
}

/// See push_elements_apart of contact/thickening.h.
template <class S>
HWY_INLINE void push_elements_apart(const Scene& scene, S& state, int ball, double force) {
  const int first = scene.incidence_offset[ball];
  for (const int element : {scene.incidence[first], scene.incidence[first + 1]}) {
    if (const double slope = state.thickening_slope[element]; slope != 0.0) {
      push_ends(scene, state, element, -0.5 * slope * force * state.axis[element]);
    }
  }
}

/// See push_by_growth of contact/thickening.h.
template <class S>
HWY_INLINE void push_by_growth(const Scene& scene, S& state, const GrownTouch& touch) {
  const Element& ends = scene.elements[touch.segment];
  const double limit =
      most_reach_now(scene, state, touch.ball, touch.segment) - reach_now(scene, state, touch.ball, touch.segment);
  const double of_ball = state.radius_growth[touch.ball];
  const double at_start = of_ball + state.radius_growth[ends.start];
  const double at_end = of_ball + state.radius_growth[ends.end];
  const double of_end = share_of_end(touch.share);
  const double on_start = at_start < limit ? (1.0 - of_end) * touch.force : 0.0;
  const double on_end = at_end < limit ? of_end * touch.force : 0.0;
  for (const auto& [ball, force] :
       {std::pair(touch.ball, on_start + on_end), std::pair(ends.start, on_start), std::pair(ends.end, on_end)}) {
    if (state.radius_growth[ball] > 0.0) {
      push_elements_apart(scene, state, ball, force);
    }
  }
  const double taper = std::min(at_end, limit) - std::min(at_start, limit);
  if (taper != 0.0 && touch.share > 0.0 && touch.share < 1.0) {
    push_along(scene, state, touch, taper);
  }
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_CONTACT_GROWTH_FORCES_INL_H_
