#include "contact/touch/force_laws.h"

#include "contact/touch_geometry-inl.h"

namespace cellcrush {
Projection project(const Vector2& point, const Vector2& start, const Vector2& axis, double length) {
  const Vector2 from_start = point - start;
  const auto foot = HWY_NAMESPACE::project_clamped(from_start.x(), from_start.y(), axis.x(), axis.y(), length);
  return {foot.along, {foot.x, foot.y}};
}

NormalForce evaluate_normal_force(double stiffness, double damping_ratio, double inverse_mass, double depth,
                                  double rate) {
  const double viscous = HWY_NAMESPACE::viscous_force(stiffness, damping_ratio, inverse_mass, rate);
  return without_pull(stiffness * depth, viscous);
}

}  // namespace cellcrush
