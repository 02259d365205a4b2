// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_CONTACT_TOUCH_RUBBED_SURFACE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_CONTACT_TOUCH_RUBBED_SURFACE_INL_H_
#undef CELLCRUSH_CONTACT_TOUCH_RUBBED_SURFACE_INL_H_
#else
#define CELLCRUSH_CONTACT_TOUCH_RUBBED_SURFACE_INL_H_
#endif

#include <span>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "cellcrush/vector.h"
#include "simd/lane-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

// Friction acts where surfaces meet, at a distance from the mid-lines (E9d). The side of a segment turns with it. The
// round surface of a ball turns with the elements that end there, by the mean of their turning weighted by length.
// Nodes inside pairs have no rotation (E5b), so a couple on a surface acts as forces across its elements. These are
// conjugate to the turning: their work is that of the couple, and they have its moment.

/// One of the two surfaces of a contact, or the one at a plate.
struct RubbedSurface {
  std::span<const int> elements;  ///< with which it turns
  double arm;                     ///< mm, from the mid-line to the point of contact
};

/// The elements at a particle: those with which its ball turns.
HWY_INLINE std::span<const int> elements_at(const Scene& scene, int particle) {
  const int first = scene.incidence_offset[particle];
  return {scene.incidence.data() + first, scene.incidence.data() + scene.incidence_offset[particle + 1]};
}

HWY_INLINE double length_of(const State& state, std::span<const int> elements) {
  double length = 0.0;
  for (const int element : elements) {
    length += state.length[element];
  }
  return length;
}

/// Speed of a surface against its mid-line, mm/s, as it turns counter-clockwise.
HWY_INLINE double speed_by_turning(const Scene& scene, const State& state, const RubbedSurface& surface) {
  double across = 0.0;  // turning times length, mm/s
  for (const int element : surface.elements) {
    const Element& ends = scene.elements[element];
    across += normal_of(state.axis[element]).dot(state.velocity[ends.end] - state.velocity[ends.start]);
  }
  return surface.arm / length_of(state, surface.elements) * across;
}

/// Adds the couple of a friction force (N), counter-clockwise, to friction_force. It is the transpose of
/// speed_by_turning: the work of these forces is that of the friction force over the way of the surface.
template <class S>
HWY_INLINE void add_couple(const Scene& scene, S& state, const RubbedSurface& surface, double force) {
  const double on_end = surface.arm / length_of(state, surface.elements) * force;
  for (const int element : surface.elements) {
    const Element& ends = scene.elements[element];
    const Vector2 across = on_end * normal_of(state.axis[element]);
    state.friction_force[ends.end] += across;
    state.friction_force[ends.start] -= across;
  }
}

/// What the stiffness of friction is divided by on a surface, together with the other: above 1 only where elements are
/// shorter than 1.4 arms. There the couple's forces are greater than friction itself, and would make its spring stiffer
/// than that of the normal force.
HWY_INLINE double stiffening(const State& state, const RubbedSurface& surface) {
  const double ratio = surface.arm / length_of(state, surface.elements);
  return 2.0 * ratio * ratio;
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_CONTACT_TOUCH_RUBBED_SURFACE_INL_H_
