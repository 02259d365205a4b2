#include "scenes/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "scenes/kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "beam/cross_section-inl.h"
#include "beam/deformation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

using One = hn::CappedTag<double, 1>;

HWY_INLINE Points<One> point(const Vector2& vector) { return Points<One>::load(&vector); }
HWY_INLINE double number(Lane<One> lane) { return hn::GetLane(lane.raw); }

double turn(const Vector2& from, const Vector2& to) { return number(turn_between(point(from), point(to))); }

scenes::ElementDeformation reverse(const Vector2& span, const Vector2& axis, double length, double turn_start,
                                   double turn_end) {
  const auto deformation = reverse_motion<One>(point(span), point(axis), length, 1.0 / length, turn_start, turn_end);
  return {number(deformation.stretch), number(deformation.rotation_start), number(deformation.rotation_end)};
}

double share_of_modulus(const Scene& scene, double shortening) {
  const CrossSection<One> section(scene, WallBlock{.walls = 1, .elements = 2}, 0);
  return number(section.modulus_share(shortening, section.thickening(shortening)));
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cellcrush {

HWY_EXPORT(turn);
HWY_EXPORT(reverse);
HWY_EXPORT(share_of_modulus);

namespace scenes {

double turn_between(const Vector2& from, const Vector2& to) { return HWY_DYNAMIC_DISPATCH(turn)(from, to); }

ElementDeformation reverse_motion(const Vector2& span, const Vector2& previous_axis, double previous_length,
                                  double turn_start, double turn_end) {
  return HWY_DYNAMIC_DISPATCH(reverse)(span, previous_axis, previous_length, turn_start, turn_end);
}

double modulus_share(double length, double undeformed, double thickness, bool in_pairs, double rotary) {
  Scene scene;
  scene.mass_scaling.rotary = rotary;
  scene.section.force_based = in_pairs;
  scene.depth = 1.0;
  scene.walls.thickness = {thickness};
  scene.walls.undeformed_length = {undeformed};
  scene.materials.resize(1);
  return HWY_DYNAMIC_DISPATCH(share_of_modulus)(scene, undeformed / length);
}

}  // namespace scenes
}  // namespace cellcrush
#endif
