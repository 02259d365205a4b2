#include "geometry/capsule.h"

#include "geometry/capsule-inl.h"

namespace cellcrush {

Projection project(const Vector2& point, const Vector2& start, const Vector2& axis, double length) {
  const Vector2 from_start = point - start;
  const auto foot = HWY_NAMESPACE::project_clamped(from_start.x(), from_start.y(), axis.x(), axis.y(), length);
  return {foot.along, {foot.x, foot.y}};
}

}  // namespace cellcrush
