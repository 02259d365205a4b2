#include "contact/touch/force_laws.h"

#include "cellcrush/vector.h"
#include "contact/touch_geometry-inl.h"

namespace cellcrush {
namespace {

double length_of(const State& state, std::span<const int> elements) {
  double length = 0.0;
  for (const int element : elements) {
    length += state.length[element];
  }
  return length;
}

}  // namespace

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

double speed_by_turning(const Scene& scene, const State& state, const RubbedSurface& surface) {
  double across = 0.0;  // turning times length, mm/s
  for (const int element : surface.elements) {
    const Element& ends = scene.elements[element];
    across += normal_of(state.axis[element]).dot(state.velocity[ends.end] - state.velocity[ends.start]);
  }
  return surface.arm / length_of(state, surface.elements) * across;
}

void add_couple(const Scene& scene, State& state, const RubbedSurface& surface, double force) {
  const double on_end = surface.arm / length_of(state, surface.elements) * force;
  for (const int element : surface.elements) {
    const Element& ends = scene.elements[element];
    const Vector2 across = on_end * normal_of(state.axis[element]);
    state.friction_force[ends.end] += across;
    state.friction_force[ends.start] -= across;
  }
}

double stiffening(const State& state, const RubbedSurface& surface) {
  const double ratio = surface.arm / length_of(state, surface.elements);
  return 2.0 * ratio * ratio;
}

}  // namespace cellcrush
